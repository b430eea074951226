// Points are put in the order of approximate minimum degree (P. R. Amestoy, T. A. Davis, I. S. Duff, 1996), each with its
// unknowns together; the matrix is assembled in that order, upper half, so that Eigen's simplicial LL^T (after T. A. Davis'
// LDL) takes it without copy or permutation.
#include "sim/implicit/linear_solver.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>
#include <string>

#include "base/errors.h"

namespace hooke {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::Map<Eigen::VectorXd>;

// Maximum number of stored entries of a factor: 3.6 GB.
constexpr std::int64_t max_entries = 300'000'000;

// The number of blocks in the strict lower half of the factor: every row is the part of the elimination tree between its couplings and
// itself.
std::int64_t count_factor_blocks(const std::vector<std::vector<Index>>& above) {
  std::vector<Index> parent(above.size(), no_index), visited(above.size(), no_index);
  std::int64_t blocks = 0;
  for (Index row = 0; row < static_cast<Index>(above.size()); ++row) {
    visited[row] = row;
    for (Index i : above[row])
      for (; visited[i] != row; i = parent[i]) {
        if (parent[i] == no_index) parent[i] = row;
        visited[i] = row;
        ++blocks;
      }
  }
  return blocks;
}

std::vector<Index> elimination_order(Index points, std::span<const std::pair<Index, Index>> couplings) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * couplings.size() + points);
  for (Index i = 0; i < points; ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [i, j] : couplings) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  Matrix graph(points, points);
  graph.setFromTriplets(entries.begin(), entries.end());

  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(graph, order);
  std::vector<Index> elimination_index(points);
  for (Index k = 0; k < points; ++k) elimination_index[order.indices()[k]] = k;
  return elimination_index;
}

}  // namespace

// LL^T of a matrix in its final order, which stops at the first pivot that is not positive. Eigen's own `factorize` would allocate memory
// for a permuted copy every time.
class Factor : public Eigen::SimplicialLLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>> {
 public:
  void analyze(const Matrix& matrix) { analyzePattern_preordered(matrix, false); }
  void factorize(const Matrix& matrix) { factorize_preordered<false>(matrix); }
};

struct LinearSolver::Implementation {
  Matrix matrix;
  Factor factor;
};

LinearSolver::LinearSolver(Index points, int dimensions, std::span<const std::pair<Index, Index>> couplings)
    : dimensions_(dimensions),
      elimination_index_(elimination_order(points, couplings)),
      implementation_(std::make_unique<Implementation>()) {
  // the points that each is coupled to and that come before it
  std::vector<std::vector<Index>> above(points);
  for (const auto& [i, j] : couplings)
    above[std::max(elimination_index_[i], elimination_index_[j])].push_back(std::min(elimination_index_[i], elimination_index_[j]));
  std::int64_t blocks = 0;
  for (auto& column : above) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    blocks += static_cast<std::int64_t>(column.size());
  }

  const std::int64_t factor_entries =
      count_factor_blocks(above) * dimensions * dimensions + std::int64_t{points} * dimensions * (dimensions + 1) / 2;
  if (factor_entries > max_entries)
    throw InputError("an implicit method: " + std::to_string(factor_entries) + " entries in the factor of its matrix: at most " +
                     std::to_string(max_entries));

  Matrix& matrix = implementation_->matrix;
  matrix.resize(points * dimensions, points * dimensions);
  matrix.resizeNonZeros(blocks * dimensions * dimensions + std::int64_t{points} * dimensions * (dimensions + 1) / 2);
  int at = 0;
  for (Index k = 0; k < points; ++k)
    for (int c = 0; c < dimensions; ++c) {
      matrix.outerIndexPtr()[dimensions * k + c] = at;
      for (const Index i : above[k])
        for (int r = 0; r < dimensions; ++r) matrix.innerIndexPtr()[at++] = dimensions * i + r;
      for (int r = 0; r <= c; ++r) matrix.innerIndexPtr()[at++] = dimensions * k + r;
    }
  matrix.outerIndexPtr()[points * dimensions] = at;
  set_zero();
  implementation_->factor.analyze(matrix);
  permuted_.resize(static_cast<std::size_t>(points) * dimensions);
}

LinearSolver::~LinearSolver() = default;

LinearSolver::Block LinearSolver::diagonal(Index point) const {
  Matrix& matrix = implementation_->matrix;
  const int* begin = matrix.outerIndexPtr() + dimensions_ * elimination_index_[point];
  Block block;
  block.stride_ = begin[1] - begin[0] - 1;
  block.start_ = matrix.valuePtr() + begin[0] + block.stride_;
  return block;
}

LinearSolver::Block LinearSolver::coupling(Index first, Index second) const {
  Matrix& matrix = implementation_->matrix;
  const auto [row, column] = std::minmax(elimination_index_[first], elimination_index_[second]);
  const int *begin = matrix.outerIndexPtr() + dimensions_ * column, *rows = matrix.innerIndexPtr();
  const int* found = std::lower_bound(rows + begin[0], rows + begin[1], dimensions_ * row);
  Block block;
  block.stride_ = begin[1] - begin[0] - 1;
  block.start_ = matrix.valuePtr() + (found - rows);
  return block;
}

void LinearSolver::set_zero() { std::fill_n(implementation_->matrix.valuePtr(), implementation_->matrix.nonZeros(), 0.0); }

bool LinearSolver::factorize() {
  implementation_->factor.factorize(implementation_->matrix);
  return implementation_->factor.info() == Eigen::Success;
}

void LinearSolver::solve(Field& b) {
  const std::size_t n = elimination_index_.size();
  for (int c = 0; c < dimensions_; ++c)
    for (std::size_t i = 0; i < n; ++i) permuted_[dimensions_ * elimination_index_[i] + c] = b[c * n + i];
  Vector x(permuted_.data(), static_cast<Eigen::Index>(permuted_.size()));
  implementation_->factor._solve_impl(x, x);
  for (int c = 0; c < dimensions_; ++c)
    for (std::size_t i = 0; i < n; ++i) b[c * n + i] = permuted_[dimensions_ * elimination_index_[i] + c];
}

}  // namespace hooke
