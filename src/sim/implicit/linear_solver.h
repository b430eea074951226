// Sparse symmetric positive definite systems A x = b, one small block of unknowns a point, of which only the values
// change: ordering, symbolic factorisation and all memory are made once.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sim/plan.h"

namespace hooke {

class LinearSolver {
 public:
  // `dimensions` unknowns a point, coupled between the given pairs of points (repeated pairs are fine, at least one
  // point). Throws InputError when the factor would not fit into memory worth having.
  LinearSolver(Index points, int dimensions, std::span<const std::pair<Index, Index>> couplings);
  ~LinearSolver();

  // Where a block of A stands: its entry (row, column) is value(column)[row], for a diagonal block with row <= column only.
  // Blocks are symmetric, so it does not matter which way round a pair is coupled.
  class Block {
   public:
    double* column(int c) const { return start_ + c * stride_ + c * (c + 1) / 2; }

   private:
    friend class LinearSolver;
    double* start_ = nullptr;
    std::ptrdiff_t stride_ = 0;  // entries above the diagonal block in its column
  };
  Block diagonal(Index point) const;
  Block coupling(Index first, Index second) const;
  void set_zero();

  // Factors the values as they stand. False when A is not positive definite; then there is nothing to solve with.
  bool factorize();

  // b becomes A^-1 b; in the Plan's layout.
  void solve(Field& b);

 private:
  struct Implementation;
  int dimensions_;
  std::vector<Index> elimination_index_;  // of each point in the order of elimination
  std::vector<double> permuted_;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hooke
