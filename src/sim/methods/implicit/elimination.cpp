#include "sim/methods/implicit/elimination.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

namespace hooke {
namespace {

std::vector<Index> minimum_degree_order(Index points, std::span<const std::pair<Index, Index>> couplings) {
  using Graph = Eigen::SparseMatrix<double>;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * couplings.size() + points);
  for (Index i = 0; i < points; ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [i, j] : couplings) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  Graph graph(points, points);
  graph.setFromTriplets(entries.begin(), entries.end());

  Eigen::AMDOrdering<int>::PermutationType permutation;
  Eigen::AMDOrdering<int>()(graph, permutation);
  std::vector<Index> order(points);
  for (Index k = 0; k < points; ++k) order[permutation.indices()[k]] = k;
  return order;
}

// Parents in the elimination tree: the first point after each that it is coupled to in L.
std::vector<Index> elimination_tree(const Couplings& before) {
  std::vector<Index> parent(before.size(), no_index), ancestor(before.size(), no_index);
  for (Index k = 0; k < static_cast<Index>(before.size()); ++k)
    for (Index i : before[k])
      while (i != no_index && i != k) {
        const Index next = ancestor[i];
        ancestor[i] = k;
        if (next == no_index) parent[i] = k;
        i = next;
      }
  return parent;
}

// For each point its place when children come before parents, and every subtree is in sequence.
std::vector<Index> postorder(const std::vector<Index>& parent) {
  const Index points = static_cast<Index>(parent.size());
  std::vector<Index> first_child(points, no_index), next_sibling(points, no_index), place(points), path;
  for (Index k = points - 1; k >= 0; --k)
    if (parent[k] != no_index) {
      next_sibling[k] = first_child[parent[k]];
      first_child[parent[k]] = k;
    }
  Index done = 0;
  for (Index root = 0; root < points; ++root) {
    if (parent[root] != no_index) continue;
    path.assign(1, root);
    while (!path.empty()) {
      const Index k = path.back();
      if (first_child[k] != no_index) {
        path.push_back(first_child[k]);
        first_child[k] = next_sibling[first_child[k]];
      } else {
        place[k] = done++;
        path.pop_back();
      }
    }
  }
  return place;
}

// For each column of L, the number of points below it.
std::vector<Index> column_counts(const Couplings& before, const std::vector<Index>& parent) {
  std::vector<Index> counts(before.size(), 0), visited(before.size(), no_index);
  for (Index k = 0; k < static_cast<Index>(before.size()); ++k) {
    visited[k] = k;
    for (Index i : before[k])
      for (; visited[i] != k; i = parent[i]) {
        visited[i] = k;
        ++counts[i];
      }
  }
  return counts;
}

// Whether joining a supernode to its parent is worth the entries that are zero: more of them for few columns, where what matters is the
// number of supernodes.
bool is_worth_joining(Index columns, double zeros, double entries) {
  if (columns > max_supernode_columns) return false;
  if (columns <= 4) return true;
  return zeros < (columns <= 8 ? 0.5 : columns <= 16 ? 0.1 : 0.05) * entries;
}

}  // namespace

std::vector<Index> elimination_order(Index points, std::span<const std::pair<Index, Index>> couplings) {
  std::vector<Index> order = minimum_degree_order(points, couplings);
  const std::vector<Index> place = postorder(elimination_tree(couplings_before(order, couplings)));
  for (Index& k : order) k = place[k];
  return order;
}

Couplings couplings_before(std::span<const Index> order, std::span<const std::pair<Index, Index>> couplings) {
  Couplings before(order.size());
  for (const auto& [i, j] : couplings) before[std::max(order[i], order[j])].push_back(std::min(order[i], order[j]));
  for (auto& points : before) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
  return before;
}

std::vector<Supernode> find_supernodes(const Couplings& before) {
  const Index points = static_cast<Index>(before.size());
  const std::vector<Index> parent = elimination_tree(before), counts = column_counts(before, parent);

  // columns in sequence with the same structure
  struct Range {
    Index first, columns, below;
    double zeros;
  };
  std::vector<Range> ranges;
  for (Index k = 0; k < points; ++k) {
    const bool continues = k > 0 && parent[k - 1] == k && counts[k - 1] == counts[k] + 1 && ranges.back().columns < max_supernode_columns;
    if (!continues) ranges.push_back({k, 0, 0, 0.0});
    ++ranges.back().columns;
    ranges.back().below = counts[k];
  }

  // from the last one on, each is joined to its parent if that follows it
  std::vector<Range> joined;
  for (auto range = ranges.rbegin(); range != ranges.rend(); ++range) {
    const Index last = range->first + range->columns - 1;
    if (!joined.empty() && parent[last] != no_index && parent[last] < joined.back().first + joined.back().columns) {
      Range& next = joined.back();
      const double columns = range->columns, all = columns + next.columns;
      const double zeros = range->zeros + next.zeros + columns * (next.columns + next.below - range->below);
      if (is_worth_joining(range->columns + next.columns, zeros, all * (all + 1.0) / 2.0 + all * next.below)) {
        next = {range->first, range->columns + next.columns, next.below, zeros};
        continue;
      }
    }
    joined.push_back(*range);
  }
  std::reverse(joined.begin(), joined.end());

  // the structure of each: what its columns are coupled to, and the structure of its children in the tree
  Couplings after(points);
  for (Index k = 0; k < points; ++k)
    for (const Index i : before[k]) after[i].push_back(k);
  std::vector<Index> node_of(points);
  for (Index s = 0; s < static_cast<Index>(joined.size()); ++s) std::fill_n(node_of.begin() + joined[s].first, joined[s].columns, s);
  std::vector<Supernode> nodes(joined.size());
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    Supernode& node = nodes[s];
    node.first = joined[s].first, node.columns = joined[s].columns;
    const Index end = node.first + node.columns;
    for (Index k = node.first; k < end; ++k)
      node.rows.insert(node.rows.end(), std::lower_bound(after[k].begin(), after[k].end(), end), after[k].end());
    std::sort(node.rows.begin(), node.rows.end());
    node.rows.erase(std::unique(node.rows.begin(), node.rows.end()), node.rows.end());
    if (node.rows.empty()) continue;
    Supernode& above = nodes[node_of[node.rows.front()]];
    const Index above_end = joined[node_of[node.rows.front()]].first + joined[node_of[node.rows.front()]].columns;
    above.rows.insert(above.rows.end(), std::lower_bound(node.rows.begin(), node.rows.end(), above_end), node.rows.end());
  }
  return nodes;
}

}  // namespace hooke
