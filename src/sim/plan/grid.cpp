#include "sim/plan/grid.h"

#include <algorithm>
#include <tuple>

#include "sim/plan/constants.h"
#include "sim/plan/plan.h"

namespace hooke {
namespace {

// Springs by their lower end and the offset to the upper one: those of a point in ascending order.
class Neighbors {
 public:
  Neighbors(std::span<const SpringRun> runs, Index points) : points_(points) {
    begin_.assign(static_cast<std::size_t>(points) + 1, 0);
    for (const SpringRun& run : runs)
      for (Index e = 0; run.second != run.first && e < run.count; ++e) ++begin_[run.first + e + 1];
    for (Index i = 0; i < points; ++i) begin_[i + 1] += begin_[i];
    springs_.resize(static_cast<std::size_t>(begin_.back()));
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    for (const SpringRun& run : runs)
      for (Index e = 0; run.second != run.first && e < run.count; ++e)
        springs_[next[run.first + e]++] = {run.second - run.first, run.begin + e};
    for (Index i = 0; i < points; ++i)
      std::sort(springs_.begin() + begin_[i], springs_.begin() + begin_[i + 1],
                [](const Item& a, const Item& b) { return std::tie(a.offset, a.spring) < std::tie(b.offset, b.spring); });
  }

  // The packed spring between point i and i + offset, the first of several; or no_index.
  Index find(Index i, Index offset) const {
    if (i < 0 || i >= points_) return no_index;
    for (Index at = begin_[i]; at < begin_[i + 1]; ++at)
      if (springs_[at].offset == offset) return springs_[at].spring;
    return no_index;
  }
  bool has(Index i, Index offset) const { return find(i, offset) != no_index; }

  // The offsets that most springs have, of those that can be the width of a grid: two of its rows are joined by springs at more than half
  // of their points.
  std::vector<Index> common_offsets() const {
    std::vector<Index> count(static_cast<std::size_t>(Grid::max_columns) + 1, 0);
    for (const Item& item : springs_)
      if (item.offset >= min_grid_columns && item.offset <= Grid::max_columns) ++count[item.offset];
    std::vector<Index> offsets;
    for (Index offset = 0; offset <= Grid::max_columns; ++offset)
      if (count[offset] > 0) offsets.push_back(offset);
    std::ranges::stable_sort(offsets, [&](Index a, Index b) { return count[a] > count[b]; });
    offsets.resize(std::min(offsets.size(), max_grid_widths));
    std::erase_if(offsets, [&](Index offset) { return 2 * count[offset] <= offset; });
    return offsets;
  }

 private:
  struct Item {
    Index offset, spring;
  };
  Index points_;
  std::vector<Item> springs_;
  std::vector<Index> begin_;
};

class GridFinder {
 public:
  GridFinder(std::span<const SpringRun> runs, Index points) : neighbors_(runs, points), points_(points), is_taken_(points, false) {}

  std::vector<Grid> find() {
    const std::vector<Index> widths = neighbors_.common_offsets();
    for (Index i = 0; i < points_; i = end_of_chain(i)) take_largest(i, widths);
    for (Index i = 0; i < points_;) {
      const Index count = std::min(end_of_chain(i) - i, Grid::max_columns);
      if (!is_taken_[i] && count >= min_grid_rope) take(i, 1, count);
      i += count;
    }
    std::sort(grids_.begin(), grids_.end(), [](const Grid& a, const Grid& b) { return a.first < b.first; });
    return std::move(grids_);
  }

 private:
  // One past the last point that a chain of springs between consecutive points leads to; chains end where grids begin.
  Index end_of_chain(Index i) const {
    while (i + 1 < points_ && neighbors_.has(i, 1) && is_taken_[i] == is_taken_[i + 1]) ++i;
    return i + 1;
  }

  // Whether the `columns` points from `start` on can be a row: none is taken, and no spring leads past its ends.
  bool is_row(Index start, Index columns) const {
    if (start < 0 || start + columns > points_ || neighbors_.has(start - 1, 1) || neighbors_.has(start + columns - 1, 1)) return false;
    return std::none_of(is_taken_.begin() + start, is_taken_.begin() + start + columns, [](bool taken) { return taken; });
  }

  // Whether most points of the row have a spring to the row below.
  bool leads_down(Index start, Index columns) const {
    Index count = 0;
    for (Index c = 0; c < columns; ++c) count += neighbors_.has(start + c, columns) ? 1 : 0;
    return 2 * count > columns;
  }

  // The largest grid that has a row from `start` on, of one of these widths: springs may be missing anywhere.
  void take_largest(Index start, const std::vector<Index>& widths) {
    Index first = 0, rows = 0, width = 0;
    for (const Index columns : widths) {
      if (!is_row(start, columns)) continue;
      Index top = start, bottom = start;
      while (is_row(top - columns, columns) && leads_down(top - columns, columns)) top -= columns;
      while (is_row(bottom + columns, columns) && leads_down(bottom, columns)) bottom += columns;
      const Index count = (bottom - top) / columns + 1;
      if (count < 2 || count * columns <= rows * width) continue;
      first = top;
      rows = count;
      width = columns;
    }
    if (rows > 0) take(first, rows, width);
  }

  void take(Index first, Index rows, Index columns) {
    Grid grid{.first = first, .rows = rows, .columns = columns};
    const Index pitch = grid.pitch();
    for (std::vector<Index>& spring : grid.spring) spring.assign(static_cast<std::size_t>(rows) * pitch, no_index);
    for (Index r = 0; r < rows; ++r)
      for (Index c = 0; c < columns; ++c) {
        const Index i = first + r * columns + c;
        const std::size_t cell = static_cast<std::size_t>(r) * pitch + c;
        const bool right = c + 1 < columns, below = r + 1 < rows;
        if (right) grid.spring[Grid::Right][cell] = neighbors_.find(i, 1);
        if (below) grid.spring[Grid::Down][cell] = neighbors_.find(i, columns);
        if (right && below) grid.spring[Grid::Diagonal][cell] = neighbors_.find(i, columns + 1);
        if (right && below) grid.spring[Grid::Anti][cell] = neighbors_.find(i + 1, columns - 1);
      }
    std::fill(is_taken_.begin() + first, is_taken_.begin() + first + rows * columns, true);
    grids_.push_back(std::move(grid));
  }

  Neighbors neighbors_;
  Index points_;
  std::vector<bool> is_taken_;
  std::vector<Grid> grids_;
};

}  // namespace

std::vector<Grid> find_grids(std::span<const SpringRun> runs, Index points, std::vector<SpringRun>& rest) {
  std::vector<Grid> grids = GridFinder(runs, points).find();

  Index springs = 0;
  for (const SpringRun& run : runs) springs += run.count;
  std::vector<bool> is_in_grid(springs, false);
  for (const Grid& grid : grids)
    for (const std::vector<Index>& spring : grid.spring)
      for (const Index s : spring)
        if (s != no_index) is_in_grid[s] = true;

  rest.clear();
  for (const SpringRun& run : runs)
    for (Index e = 0; e < run.count; ++e) {
      if (is_in_grid[run.begin + e]) continue;
      if (e > 0 && !is_in_grid[run.begin + e - 1])
        ++rest.back().count;
      else
        rest.push_back({run.begin + e, run.first + e, run.second + e, 1});
    }
  return grids;
}

void set_values(const Grid& grid, std::span<const double> per_spring, bool each_row, std::array<Grid::Values, Grid::directions>& values) {
  const auto pitch = static_cast<std::size_t>(grid.pitch());
  for (std::size_t direction = 0; direction < Grid::directions; ++direction) {
    const std::vector<Index>& spring = grid.spring[direction];
    const auto number_of = [&](std::size_t cell) { return spring[cell] == no_index ? 0.0 : per_spring[spring[cell]]; };
    // the last row has springs to the right only; no kernel reads the others
    const std::size_t rows = grid.rows - (direction == Grid::Right ? 0 : 1);
    bool is_uniform = !each_row;
    for (std::size_t cell = pitch; is_uniform && cell < rows * pitch; ++cell) is_uniform = number_of(cell) == number_of(cell % pitch);

    Grid::Values& value = values[direction];
    value.row_step = is_uniform ? 0 : pitch;
    value.number.resize(is_uniform ? pitch : rows * pitch);
    for (std::size_t cell = 0; cell < value.number.size(); ++cell) value.number[cell] = rows == 0 ? 0.0 : number_of(cell);
  }
}

}  // namespace hooke
