#include "sim/plan/numbering/lattices.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <tuple>
#include <utility>

#include "sim/plan/constants.h"
#include "sim/plan/grid.h"

namespace hooke {
namespace {

struct Place {
  Index row = 0, column = 0;
  bool operator==(const Place&) const = default;
};
Place operator+(Place a, Place b) { return {a.row + b.row, a.column + b.column}; }
Place operator-(Place a, Place b) { return {a.row - b.row, a.column - b.column}; }

// Calls use(j) for the points that both i and k have a spring to.
template <class Use>
void for_each_common(const SpringGraph& graph, Index i, Index k, const Use& use) {
  const auto first = graph.neighbors(i), second = graph.neighbors(k);
  for (std::size_t a = 0, b = 0; a < first.size() && b < second.size();) {
    if (first[a] == second[b]) use(first[a]);
    const bool first_is_behind = first[a] <= second[b], second_is_behind = second[b] <= first[a];
    a += first_is_behind ? 1 : 0;
    b += second_is_behind ? 1 : 0;
  }
}

// How the cells of a connected part are filled, by the mean number of springs of its points: 4, 6 or 8 inside.
enum class Cells { Open, OneDiagonal, BothDiagonals };

std::vector<Cells> find_cells(const SpringGraph& graph) {
  const auto n = static_cast<std::size_t>(graph.points());
  std::vector<Cells> cells(n, Cells::Open);
  std::vector<bool> is_known(n, false);
  std::vector<Index> part;
  for (Index start = 0; start < graph.points(); ++start) {
    if (is_known[start]) continue;
    part.assign(1, start);
    is_known[start] = true;
    double ends = 0.0;
    for (std::size_t at = 0; at < part.size(); ++at) {
      ends += graph.degree(part[at]);
      for (const Index j : graph.neighbors(part[at])) {
        if (!is_known[j]) part.push_back(j);
        is_known[j] = true;
      }
    }
    const double mean = ends / static_cast<double>(part.size());
    const Cells kind = mean < 4.5 ? Cells::Open : mean < 6.3 ? Cells::OneDiagonal : Cells::BothDiagonals;
    for (const Index i : part) cells[i] = kind;
  }
  return cells;
}

// Where cells have both diagonals, the ends of a spring along a thread have four common neighbors inside of the net, those of a diagonal
// two. On the border the former have two as well.
bool is_thread(const SpringGraph& graph, Index i, Index j) {
  constexpr Index on_border = 5, at_corner = 3;
  Index common = 0;
  bool cuts_corner = false;
  for_each_common(graph, i, j, [&](Index k) {
    ++common;
    cuts_corner = cuts_corner || graph.degree(k) <= at_corner;
  });
  return common > 2 || (graph.degree(i) <= on_border && graph.degree(j) <= on_border && !cuts_corner);
}

// The same graph without the diagonals of cells that have both.
SpringGraph without_diagonals(const SpringGraph& graph, const std::vector<Cells>& cells) {
  std::vector<EdgeEnds> edges;
  for (Index i = 0; i < graph.points(); ++i)
    for (const Index j : graph.neighbors(i)) {
      if (j < i) continue;
      const bool is_dense = graph.degree(i) > max_net_degree || graph.degree(j) > max_net_degree;
      if (cells[i] != Cells::BothDiagonals || is_dense || is_thread(graph, i, j)) edges.push_back({i, j});
    }
  return {graph.points(), edges};
}

class LatticeFinder {
 public:
  LatticeFinder(const SpringGraph& graph, const std::vector<Cells>& cells)
      : graph_(graph), cells_(cells), place_(graph.points()), is_placed_(graph.points(), 0) {}

  std::vector<LatticePoints> find() {
    std::vector<LatticePoints> lattices;
    for (Index i = 0; i < graph_.points(); ++i) {
      if (is_placed_[i] || graph_.degree(i) > max_net_degree || !begin_at(i)) continue;
      for (std::size_t next = 0; next < fronts_.size(); ++next) {
        const Front front = fronts_[next];
        cells_[front.first] == Cells::OneDiagonal ? add_triangle(front) : add_cell(front);
      }
      if (static_cast<Index>(part_.size()) >= min_lattice_points && is_regular()) lattices.push_back(sort_part());
    }
    return lattices;
  }

 private:
  // The spring from which the next cell is looked for, and the points next to its ends on the side that is known; of a triangle, twice the
  // same.
  struct Front {
    Index first, second, behind_first, behind_second;
  };

  void put(Index i, Place place) {
    place_[i] = place;
    is_placed_[i] = 1;
    part_.push_back(i);
  }
  bool fits(Index i, Place place) const { return is_placed_[i] ? place_[i] == place : graph_.degree(i) <= max_net_degree; }
  void add_fronts_of_cell(Index a, Index b, Index c, Index d) {
    fronts_.push_back({a, c, b, d});
    fronts_.push_back({b, d, a, c});
    fronts_.push_back({c, d, a, b});
  }

  // A cell, or a triangle, that begins at this point.
  bool begin_at(Index i) {
    part_.clear();
    fronts_.clear();
    const auto is_free = [&](Index j) { return !is_placed_[j] && graph_.degree(j) <= max_net_degree; };
    for (const Index j : graph_.neighbors(i)) {
      if (!is_free(j)) continue;
      for (const Index k : graph_.neighbors(i)) {
        if (k == j || !is_free(k)) continue;
        if (cells_[i] == Cells::OneDiagonal) {
          if (!graph_.joins(j, k)) continue;
          put(i, {0, 0});
          put(j, {0, 1});
          put(k, {1, 0});
          fronts_.insert(fronts_.end(), {{i, j, k, k}, {i, k, j, j}, {j, k, i, i}});
          return true;
        }
        for (const Index l : graph_.neighbors(j)) {
          if (l == i || l == k || !is_free(l) || !graph_.joins(k, l)) continue;
          put(i, {0, 0});
          put(j, {0, 1});
          put(k, {1, 0});
          put(l, {1, 1});
          fronts_.push_back({i, j, k, l});
          add_fronts_of_cell(i, j, k, l);
          return true;
        }
      }
    }
    return false;
  }

  // The neighbors of a point that may be at this place across the front.
  struct Candidates {
    std::array<Index, max_net_degree> points;
    int count = 0;
    bool has_placed = false;
  };
  Candidates candidates(Index i, Place place, const Front& front) const {
    Candidates result;
    for (const Index j : graph_.neighbors(i)) {
      if (j == front.first || j == front.second || j == front.behind_first || j == front.behind_second || !fits(j, place)) continue;
      result.points[result.count++] = j;
      result.has_placed = result.has_placed || is_placed_[j];
    }
    return result;
  }

  // The points across a spring, if there is one pair of them that is joined and in its place or not yet placed.
  void add_cell(const Front& front) {
    const auto [a, b, behind_a, behind_b] = front;
    const Place at_c = place_[a] + place_[a] - place_[behind_a], at_d = place_[b] + place_[b] - place_[behind_b];
    const Candidates beyond_a = candidates(a, at_c, front);
    if (beyond_a.count == 0) return;
    const Candidates beyond_b = candidates(b, at_d, front);
    if (beyond_a.has_placed && beyond_b.has_placed) return;
    Index c = no_index, d = no_index;
    int found = 0;
    for (int x = 0; x < beyond_a.count; ++x)
      for (int y = 0; y < beyond_b.count; ++y) {
        if (beyond_a.points[x] == beyond_b.points[y] || !graph_.joins(beyond_a.points[x], beyond_b.points[y])) continue;
        c = beyond_a.points[x];
        d = beyond_b.points[y];
        ++found;
      }
    if (found != 1) return;
    if (!is_placed_[c]) put(c, at_c);
    if (!is_placed_[d]) put(d, at_d);
    add_fronts_of_cell(a, b, c, d);
  }

  // The point across a spring. Where it is known from another triangle, it has led to the springs of that one only: those of this one are
  // looked across at once.
  void add_triangle(const Front& front, bool looks_further = true) {
    const Index a = front.first, b = front.second, behind = front.behind_first;
    const Place at_c = place_[a] + place_[b] - place_[behind];
    Index c = no_index;
    int found = 0;
    for_each_common(graph_, a, b, [&](Index x) {
      if (x == behind || !fits(x, at_c)) return;
      c = x;
      ++found;
    });
    if (found != 1) return;
    if (is_placed_[c]) {
      if (!looks_further) return;
      add_triangle({a, c, b, b}, false);
      add_triangle({b, c, a, a}, false);
      return;
    }
    put(c, at_c);
    fronts_.insert(fronts_.end(), {{a, c, b, b}, {b, c, a, a}});
  }

  // Whether most springs of the part join neighbors in rows and columns. Where that is not so, as in meshes of triangles in which other
  // numbers than six meet at many points, the places mean nothing.
  bool is_regular() const {
    std::size_t inside = 0, near = 0;
    for (const Index i : part_)
      for (const Index j : graph_.neighbors(i)) {
        const Place apart = place_[j] - place_[i];
        inside += 1;
        near += is_placed_[j] && std::abs(apart.row) <= 1 && std::abs(apart.column) <= 1 && apart != Place{} ? 1 : 0;
      }
    return 10 * near >= 9 * inside;
  }

  // The part in rows, which are the longer side if kernels take rows of that length. With one diagonal, any of the three directions may be
  // that of the diagonals: the one for which the net fills most of a rectangle is.
  LatticePoints sort_part() {
    using Columns = Place (*)(Place);
    constexpr Columns views[] = {[](Place at) { return at; },
                                 [](Place at) {
                                   return Place{at.row + at.column, -at.column};
                                 },
                                 [](Place at) {
                                   return Place{at.row, at.row + at.column};
                                 }};
    const std::size_t count = cells_[part_.front()] == Cells::OneDiagonal ? 3 : 1;
    Columns best = views[0];
    double min_area = std::numeric_limits<double>::infinity();
    Place size;
    for (std::size_t view = 0; view < count; ++view) {
      Place min = views[view](place_[part_.front()]), max = min;
      for (const Index i : part_) {
        const Place at = views[view](place_[i]);
        min = {std::min(min.row, at.row), std::min(min.column, at.column)};
        max = {std::max(max.row, at.row), std::max(max.column, at.column)};
      }
      const Place extent = max - min + Place{1, 1};
      const double area = static_cast<double>(extent.row) * extent.column;
      if (!(area < min_area)) continue;
      min_area = area;
      best = views[view];
      size = extent;
    }
    const bool is_turned = size.row > size.column ? size.row <= Grid::max_columns : size.column > Grid::max_columns;

    std::vector<std::tuple<Index, Index, Index>> sorted;
    sorted.reserve(part_.size());
    for (const Index i : part_) {
      const Place at = best(place_[i]);
      sorted.emplace_back(is_turned ? at.column : at.row, is_turned ? at.row : at.column, i);
    }
    std::ranges::sort(sorted);
    LatticePoints points;
    points.reserve(sorted.size());
    for (const auto& [row, column, i] : sorted) points.push_back(i);
    return points;
  }

  const SpringGraph& graph_;
  const std::vector<Cells>& cells_;
  std::vector<Place> place_;
  std::vector<char> is_placed_;
  std::vector<Index> part_;  // the points of the present net
  std::vector<Front> fronts_;
};

}  // namespace

std::vector<LatticePoints> find_lattices(const SpringGraph& graph) {
  const std::vector<Cells> cells = find_cells(graph);
  if (std::ranges::find(cells, Cells::BothDiagonals) == cells.end()) return LatticeFinder(graph, cells).find();
  return LatticeFinder(without_diagonals(graph, cells), cells).find();
}

}  // namespace hooke
