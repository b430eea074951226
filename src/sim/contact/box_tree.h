// The broad phase of all contact: a tree of bounding boxes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/contact/box_kernel.h"

namespace hooke {

class BoxTree {
 public:
  // A leaf has no children but some items, which are at these positions of `order`; else its children are the next node and `second`.
  struct Node {
    SurfaceBox box;
    BoxRange items;
    Index second = no_index;
  };
  static constexpr Index max_per_leaf = 12;

  // Sorts items by these places; coordinates that are not finite count as 0. O(n log n).
  void build(std::span<const Vec3> places);
  bool is_built() const { return !nodes_.empty(); }
  void clear() { nodes_.clear(); }
  std::span<const Index> order() const { return order_; }
  // Calls box_of(range) for the items of each leaf, and fits all others to them.
  template <class BoxOf>
  void fit(const BoxOf& box_of);
  // Calls visit(a, b) for the leaves whose boxes are no farther apart than `reach` [m], each with itself as well; stops when it returns
  // false.
  template <class Visit>
  void visit_close(double reach, const Visit& visit) const;
  // Calls visit(item) for the items of the leaves whose boxes are within `reach` [m] of a place.
  template <class Visit>
  void visit_near(const Vec3& place, double reach, const Visit& visit) const;

 private:
  void split(Index first, Index end);

  std::vector<Node> nodes_;  // parents before their children
  std::vector<Index> order_;
  std::vector<Vec3> places_;
};

// [m^2]
inline double square_of_distance(const SurfaceBox& a, const SurfaceBox& b) {
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double gap = std::max(0.0, std::max(a.min[c] - b.max[c], b.min[c] - a.max[c]));
    sum += gap * gap;
  }
  return sum;
}

template <class BoxOf>
void BoxTree::fit(const BoxOf& box_of) {
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.second == no_index) {
      node.box = box_of(node.items);
    } else {
      node.box = nodes_[i + 1].box;
      node.box.include(nodes_[node.second].box);
    }
  }
}

template <class Visit>
void BoxTree::visit_close(double reach, const Visit& visit) const {
  if (nodes_.empty()) return;
  // at most three for each level of the tree of both
  std::array<std::array<Index, 2>, 256> open;
  std::size_t count = 0;
  const auto push = [&](Index a, Index b) { open[count++] = {a, b}; };
  push(0, 0);
  while (count > 0) {
    const auto [a, b] = open[--count];
    const Node &first = nodes_[a], &second = nodes_[b];
    if (a == b && first.second != no_index) {
      push(first.second, first.second);
      push(a + 1, first.second);
      push(a + 1, a + 1);
      continue;
    }
    if (a != b) {
      if (square_of_distance(first.box, second.box) > reach * reach * (1.0 + 1e-12)) continue;
      // halves the one with more items
      const auto size = [](const Node& node) { return node.items.end - node.items.begin; };
      const bool splits_first = first.second != no_index && (second.second == no_index || size(first) >= size(second));
      if (splits_first || second.second != no_index) {
        push(splits_first ? first.second : a, splits_first ? b : second.second);
        push(splits_first ? a + 1 : a, splits_first ? b : b + 1);
        continue;
      }
    }
    if (!visit(first, second)) return;
  }
}

template <class Visit>
void BoxTree::visit_near(const Vec3& place, double reach, const Visit& visit) const {
  if (nodes_.empty()) return;
  // at most one for each level
  std::array<Index, 64> open{0};
  for (std::size_t count = 1; count > 0;) {
    const Index n = open[--count];
    const Node& node = nodes_[n];
    if (square_of_distance(node.box, {place, place}) > reach * reach) continue;
    if (node.second != no_index)
      open[count++] = node.second, open[count++] = n + 1;
    else
      for (Index k = node.items.begin; k < node.items.end; ++k) visit(order_[k]);
  }
}

}  // namespace hooke
