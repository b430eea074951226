#include "sim/contact/box_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hooke {

void BoxTree::build(std::span<const Vec3> places) {
  const auto n = static_cast<Index>(places.size());
  nodes_.clear();
  order_.resize(places.size());
  std::iota(order_.begin(), order_.end(), 0);
  places_.assign(places.begin(), places.end());
  for (Vec3& place : places_)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(place[c])) place[c] = 0.0;
  split(0, n);
}

// In halves along the longest axis.
void BoxTree::split(Index first, Index end) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({.box = {}, .items = {first, end}});
  const auto at = [&](Index position) { return order_.begin() + position; };
  if (end - first <= max_per_leaf) {
    std::sort(at(first), at(end));
    return;
  }
  const auto place_of = [&](Index i) -> const Vec3& { return places_[i]; };
  SurfaceBox box{place_of(order_[first]), place_of(order_[first])};
  for (Index p = first; p < end; ++p) box.include({place_of(order_[p]), place_of(order_[p])});
  const Vec3 size = box.max - box.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const Index middle = first + (end - first) / 2;
  std::nth_element(at(first), at(middle), at(end), [&](Index a, Index b) {
    return std::pair{place_of(a)[axis], a} < std::pair{place_of(b)[axis], b};
  });
  split(first, middle);
  nodes_[node].second = static_cast<Index>(nodes_.size());
  split(middle, end);
}

}  // namespace hooke
