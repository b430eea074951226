#include "sim/implicit/stiffness.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "sim/forces/field_kernel.h"

namespace hooke {
namespace {

template <class Use>
void for_each_spring(const Plan& plan, const Use& use) {
  for (const SpringRun& run : plan.runs)
    for (Index e = 0; e < run.count; ++e) use(run.first + e, run.second + e, run.begin + e);
}

std::vector<std::pair<Index, Index>> couplings_of(const Plan& plan) {
  std::vector<std::pair<Index, Index>> pairs;
  pairs.reserve(plan.springs);
  for_each_spring(plan, [&](Index i, Index j, Index) { pairs.emplace_back(i, j); });
  return pairs;
}

// What a spring adds to the matrix: along u u^T + across I, `along` being the difference of both stiffnesses.
template <int Dimensions>
struct SpringContribution {
  double u[Dimensions];
  double uniaxial, isotropic;

  double entry(int r, int c) const { return uniaxial * u[r] * u[c] + (r == c ? isotropic : 0.0); }
};

template <int Dimensions>
SpringContribution<Dimensions> spring_contribution(const Plan& plan, double b, Index i, Index j, Index s, const double* x, const double* v,
                                                   Curvature curvature) {
  const std::size_t n = plan.points;
  const double k = plan.stiffness[s], d = plan.has_dashpots() ? plan.damping[s] : 0.0;
  SpringContribution<Dimensions> contribution;
  double length_squared = 0.0, approach = 0.0;
  for (int c = 0; c < Dimensions; ++c) {
    contribution.u[c] = x[c * n + i] - x[c * n + j];
    length_squared += contribution.u[c] * contribution.u[c];
    approach += contribution.u[c] * (v[c * n + i] - v[c * n + j]);
  }
  if (length_squared == 0.0) {
    contribution.uniaxial = 0.0;
    contribution.isotropic = b * b * k;
    return contribution;
  }

  const double length = std::sqrt(length_squared);
  for (double& component : contribution.u) component /= length;
  const double tension = k * (length - plan.rest_length[s]) + d * approach / length;
  contribution.isotropic = b * b * tension / length;
  if (curvature == Curvature::Clamped) contribution.isotropic = std::max(0.0, contribution.isotropic);
  contribution.uniaxial = b * (b * k + d) - contribution.isotropic;
  return contribution;
}

}  // namespace

StiffnessMatrix::StiffnessMatrix(const Plan& plan) : solver_(plan.points, plan.dimensions, couplings_of(plan)) {
  for (Index i = 0; i < plan.points; ++i) diagonal_.push_back(solver_.diagonal(i));
  coupling_.resize(plan.springs);
  for_each_spring(plan, [&](Index i, Index j, Index s) { coupling_[s] = solver_.coupling(i, j); });
}

template <int Dimensions>
void StiffnessMatrix::add_springs(const Plan& plan, double b, const double* x, const double* v, Curvature curvature) {
  const auto add = [](LinearSolver::Block block, const SpringContribution<Dimensions>& contribution) {
    for (int c = 0; c < Dimensions; ++c)
      for (int r = 0; r <= c; ++r) block.column(c)[r] += contribution.entry(r, c);
  };

  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const bool first_moves = plan.inverse_mass[i] != 0.0, second_moves = plan.inverse_mass[j] != 0.0;
    if (!first_moves && !second_moves) return;
    const auto contribution = spring_contribution<Dimensions>(plan, b, i, j, s, x, v, curvature);
    if (first_moves) add(diagonal_[i], contribution);
    if (second_moves) add(diagonal_[j], contribution);
    if (!first_moves || !second_moves) return;
    for (int c = 0; c < Dimensions; ++c)
      for (int r = 0; r < Dimensions; ++r) coupling_[s].column(c)[r] -= contribution.entry(r, c);
  });
}

void StiffnessMatrix::allocate(const Plan& plan) {
  if (!plan.pull || plan.pull->count == 1) return;
  for (int c = 0; c < plan.dimensions; ++c) response_[c].resize(static_cast<std::size_t>(plan.points) * plan.dimensions);
}

void StiffnessMatrix::assemble(const Plan& plan, double b, const Field& x, const Field& v, Curvature curvature) {
  solver_.set_zero();
  for (Index i = 0; i < plan.points; ++i) {
    const bool pulled = plan.pull && plan.pull->count == 1 && plan.pull->parts[0].point == i && plan.inverse_mass[i] != 0.0;
    const double diagonal = plan.mass[i] * (1.0 + b * plan.drag) + (pulled ? b * b * plan.pull->stiffness : 0.0);
    for (int c = 0; c < plan.dimensions; ++c) diagonal_[i].column(c)[c] += diagonal;
  }
  pull_.reset();
  if (plan.pull && plan.pull->count > 1) {
    pull_ = plan.pull;
    weight_ = b * b * pull_->stiffness;
    for (PlannedPull::Part& part : pull_->parts)
      if (plan.inverse_mass[part.point] == 0.0) part.weight = 0.0;
  }
  if (plan.dimensions == 2)
    add_springs<2>(plan, b, x.data(), v.data(), curvature);
  else
    add_springs<3>(plan, b, x.data(), v.data(), curvature);
}

bool StiffnessMatrix::factorize() {
  if (!solver_.factorize()) return false;
  if (!pull_) return true;
  const int dimensions = static_cast<int>(response_[0].size() / diagonal_.size());
  glm::dmat3 unit(1.0);
  for (int c = 0; c < dimensions; ++c) {
    Field& z = response_[c];
    std::fill(z.begin(), z.end(), 0.0);
    for (const auto& [point, weight] : pull_->points()) z[c * diagonal_.size() + point] += weight;
    solver_.solve(z);
    for (int r = 0; r < dimensions; ++r) unit[c][r] += weight_ * pull_->interpolate(&z[r * diagonal_.size()]);
  }
  gain_ = weight_ * glm::inverse(unit);
  return true;
}

void StiffnessMatrix::solve(Field& b) {
  solver_.solve(b);
  if (!pull_) return;
  const std::size_t n = diagonal_.size(), dimensions = b.size() / n;
  glm::dvec3 projection(0.0);
  for (std::size_t c = 0; c < dimensions; ++c) projection[static_cast<int>(c)] = pull_->interpolate(&b[c * n]);
  const glm::dvec3 correction = gain_ * projection;
  for (std::size_t c = 0; c < dimensions; ++c) add_scaled(b.data(), -correction[static_cast<int>(c)], response_[c].data(), b.size());
}

}  // namespace hooke
