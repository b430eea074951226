#include "sim/methods/implicit/linear_solver.h"

#include <algorithm>

namespace hooke {

LinearSolver::LinearSolver(Index points, int dimensions, std::span<const std::pair<Index, Index>> couplings)
    : dimensions_(dimensions),
      order_(elimination_order(points, couplings)),
      before_(couplings_before(order_, couplings)),
      factor_(dimensions, before_) {
  first_block_.reserve(points);
  for (Index k = 0; k < points; ++k) {
    first_block_.push_back(in_factor_.size());
    for (const Index i : before_[k]) in_factor_.push_back(factor_.block(k, i));
    in_factor_.push_back(factor_.block(k, k));
  }
  matrix_.resize(in_factor_.size() * dimensions * dimensions);
  permuted_.resize(static_cast<std::size_t>(points) * dimensions);
}

LinearSolver::Block LinearSolver::diagonal(Index point) { return block(first_block_[order_[point]] + before_[order_[point]].size()); }

LinearSolver::Block LinearSolver::coupling(Index first, Index second) {
  const auto [row, column] = std::minmax(order_[first], order_[second]);
  const std::vector<Index>& rows = before_[column];
  return block(first_block_[column] + (std::lower_bound(rows.begin(), rows.end(), row) - rows.begin()));
}

void LinearSolver::set_zero() { std::fill(matrix_.begin(), matrix_.end(), 0.0); }

template <int Dimensions>
void LinearSolver::copy_to_factor() {
  const double* value = matrix_.data();
  for (const ColumnBlock& block : in_factor_)
    for (int c = 0; c < Dimensions; ++c)
      for (int r = 0; r < Dimensions; ++r) block.start[r * block.stride + c] = *value++;
}

bool LinearSolver::factorize() {
  factor_.set_zero();
  dimensions_ == 1 ? copy_to_factor<1>() : dimensions_ == 2 ? copy_to_factor<2>() : copy_to_factor<3>();
  return factor_.factorize();
}

void LinearSolver::solve(std::span<double> b) {
  const std::size_t n = order_.size();
  for (int c = 0; c < dimensions_; ++c)
    for (std::size_t i = 0; i < n; ++i) permuted_[dimensions_ * order_[i] + c] = b[c * n + i];
  factor_.solve(permuted_);
  for (int c = 0; c < dimensions_; ++c)
    for (std::size_t i = 0; i < n; ++i) b[c * n + i] = permuted_[dimensions_ * order_[i] + c];
}

}  // namespace hooke
