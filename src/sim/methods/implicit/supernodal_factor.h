// L L^T of a sparse symmetric positive definite matrix with a small block of unknowns per point, in dense blocks of columns: each is
// computed from the blocks before it that reach its columns (left-looking; E. Ng, B. Peyton, Block sparse Cholesky algorithms on advanced
// uniprocessor computers, 1993). Structure and memory are set up once.
#pragma once

#include <cstddef>
#include <exception>
#include <span>
#include <vector>

#include "sim/methods/constants.h"
#include "sim/methods/implicit/cholesky_kernel.h"
#include "sim/methods/implicit/elimination.h"

namespace hooke {

// The factor would have more than max_factor_entries.
struct MatrixTooLarge : std::exception {};

class SupernodalFactor {
 public:
  // `dimensions` unknowns per point. Throws MatrixTooLarge.
  SupernodalFactor(int dimensions, const Couplings& before);

  // The matrix to factorize is set here, and replaced by L: after set_zero, the block of a point's rows and the columns of itself or of one
  // before it that it is coupled to.
  void set_zero();
  ColumnBlock block(Index row, Index column);

  // False if the matrix is not positive definite; then it cannot solve.
  bool factorize();
  // x becomes L^-T L^-1 x.
  void solve(std::span<double> x);

 private:
  struct Panel {
    Supernode node;
    std::size_t start, stride;  // in values_
    Index next_row = 0;         // the first of the node's rows whose supernode has not been updated by it
    Index next_source = no_index;
  };
  ColumnBlock block_of(const Panel& panel) { return {values_.data() + panel.start, panel.stride}; }
  void update(Panel& target, Panel& source);
  void pass_on(Index source);

  std::size_t dimensions_;
  std::vector<Panel> panels_;
  std::vector<Index> panel_of_;  // of each point
  std::vector<double> values_, product_, part_;
  // while factorizing: of each panel, the list of those that update it; of each point, its place in the rows of the panel at hand
  std::vector<Index> first_source_, place_;
};

}  // namespace hooke
