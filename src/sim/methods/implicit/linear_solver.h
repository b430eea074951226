// Sparse symmetric positive definite systems A x = b with a small block of unknowns per point, of which only the values
// change: ordering, symbolic factorization and memory are set up once.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "sim/methods/implicit/elimination.h"
#include "sim/methods/implicit/supernodal_factor.h"
#include "sim/plan/plan.h"

namespace hooke {

class LinearSolver {
 public:
  // `dimensions` unknowns per point, coupled between the given pairs of points (pairs may repeat; at least one
  // point). Throws MatrixTooLarge (supernodal_factor.h).
  LinearSolver(Index points, int dimensions, std::span<const std::pair<Index, Index>> couplings);

  // A block of A: its entry (row, column) is column(column)[row], in a diagonal block for row <= column only.
  // Where blocks are symmetric, the order of a pair does not matter.
  struct Block {
    double* start = nullptr;
    int dimensions = 0;
    double* column(int c) const { return start + c * dimensions; }
  };
  Block diagonal(Index point);
  Block coupling(Index first, Index second);
  // Whether the rows of the block of this pair are those of `first`: of a block that is not symmetric, the transpose is stored otherwise.
  bool precedes(Index first, Index second) const { return order_[first] < order_[second]; }
  void set_zero();

  // Factors the current values. False if A is not positive definite; then it cannot solve.
  bool factorize();

  // b becomes A^-1 b; in the Plan's layout.
  void solve(std::span<double> b);

 private:
  Block block(std::size_t index) { return {matrix_.data() + index * dimensions_ * dimensions_, dimensions_}; }
  template <int Dimensions>
  void copy_to_factor();

  int dimensions_;
  std::vector<Index> order_;  // of each point, its place in the order of elimination
  // A: for each point in that order, the blocks with those before it and then its own
  Couplings before_;
  std::vector<std::size_t> first_block_;
  std::vector<double> matrix_;
  SupernodalFactor factor_;
  std::vector<ColumnBlock> in_factor_;  // of each block, transposed
  std::vector<double> permuted_;
};

}  // namespace hooke
