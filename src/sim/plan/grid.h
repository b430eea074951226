// Grids in the graph of springs: points in rows, each joined to its neighbors.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.h"

namespace hooke {

struct SpringRun;

// `rows` x `columns` consecutive points, row by row from `first`; any of the springs that join neighbors may be missing:
//
//   (r, c) --Right-- (r, c+1)
//      | \         /  |
//     Down  Diagonal  |
//      |   Anti       |
//      | /         \  |
//   (r+1, c) ----- (r+1, c+1)
//
// A row of its own is a grid too. Cell (r, c) owns the four springs that have their ends at (r, c) and to its right and below.
struct Grid {
  enum Direction { Right, Down, Diagonal, Anti };
  static constexpr std::size_t directions = 4;
  static constexpr Index lanes = 8;           // of the widest vectors
  static constexpr Index max_columns = 4096;  // kernels keep some rows on the stack

  // One number per cell, in rows of `pitch`. Missing springs have zeros, and so has the padding of a row. If all rows are the same,
  // one is stored and row_step is 0.
  struct Values {
    std::vector<double> number;
    std::size_t row_step = 0;
    const double* row(Index r) const { return number.data() + static_cast<std::size_t>(r) * row_step; }
  };

  Index first = 0, rows = 0, columns = 0;
  std::array<std::vector<Index>, directions> spring;  // packed index of each cell's spring, or no_index
  std::array<Values, directions> stiffness, rest_length;
  std::array<Values, directions> damping;  // empty: no dashpots

  Index points() const { return rows * columns; }
  // Columns rounded up to whole vectors.
  Index pitch() const { return (columns + lanes - 1) / lanes * lanes; }
};

// Finds disjoint grids in the springs of `runs`, in ascending order of their points. The runs that are left, split where grids
// took springs out of them, go to `rest`. Independent of the order in which springs were made, but not of that of the points.
std::vector<Grid> find_grids(std::span<const SpringRun> runs, Index points, std::vector<SpringRun>& rest);

// Copies the number of each packed spring to the cells; 0 where there is no spring. With `each_row` every row is stored, even if
// all are the same, so that doing it again allocates nothing.
void set_values(const Grid& grid, std::span<const double> per_spring, bool each_row, std::array<Grid::Values, Grid::directions>& values);

}  // namespace hooke
