// Sparse symmetric positive definite systems A x = b with a small block of unknowns per point, of which only the values
// change: ordering, symbolic factorization and memory are set up once.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sim/plan.h"

namespace hooke {

class LinearSolver {
 public:
  // `dimensions` unknowns per point, coupled between the given pairs of points (pairs may repeat; at least one
  // point). Throws InputError if the factor would need too much memory.
  LinearSolver(Index points, int dimensions, std::span<const std::pair<Index, Index>> couplings);
  ~LinearSolver();

  // A block of A: its entry (row, column) is column(column)[row], in a diagonal block for row <= column only.
  // Where blocks are symmetric, the order of a pair does not matter.
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
  // Whether the rows of the block of this pair are those of `first`: of a block that is not symmetric, the transpose is stored otherwise.
  bool precedes(Index first, Index second) const { return elimination_index_[first] < elimination_index_[second]; }
  void set_zero();

  // Factors the current values. False if A is not positive definite; then it cannot solve.
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
