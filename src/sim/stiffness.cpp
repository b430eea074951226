#include "sim/stiffness.h"

#include <algorithm>
#include <cmath>

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
struct Share {
  double u[Dimensions];
  double along, across;

  double entry(int r, int c) const { return along * u[r] * u[c] + (r == c ? across : 0.0); }
};

template <int Dimensions>
Share<Dimensions> share_of(const Plan& plan, double b, Index i, Index j, Index s, const double* x, const double* v, Curvature curvature) {
  const std::size_t n = plan.points;
  const double k = plan.stiffness[s], d = plan.has_dashpots() ? plan.damping[s] : 0.0;
  Share<Dimensions> share;
  double length_squared = 0.0, approach = 0.0;
  for (int c = 0; c < Dimensions; ++c) {
    share.u[c] = x[c * n + i] - x[c * n + j];
    length_squared += share.u[c] * share.u[c];
    approach += share.u[c] * (v[c * n + i] - v[c * n + j]);
  }
  if (length_squared == 0.0) {
    share.along = 0.0;
    share.across = b * b * k;
    return share;
  }

  const double length = std::sqrt(length_squared);
  for (double& component : share.u) component /= length;
  const double tension = k * (length - plan.rest_length[s]) + d * approach / length;
  share.across = b * b * tension / length;
  if (curvature == Curvature::Clamped) share.across = std::max(0.0, share.across);
  share.along = b * (b * k + d) - share.across;
  return share;
}

}  // namespace

StiffnessMatrix::StiffnessMatrix(const Plan& plan) : solver_(plan.points, plan.dimensions, couplings_of(plan)) {
  for (Index i = 0; i < plan.points; ++i) diagonal_.push_back(solver_.diagonal(i));
  coupling_.resize(plan.springs);
  for_each_spring(plan, [&](Index i, Index j, Index s) { coupling_[s] = solver_.coupling(i, j); });
}

template <int Dimensions>
void StiffnessMatrix::add_springs(const Plan& plan, double b, const double* x, const double* v, Curvature curvature) {
  const auto add = [](LinearSolver::Block block, const Share<Dimensions>& share) {
    for (int c = 0; c < Dimensions; ++c)
      for (int r = 0; r <= c; ++r) block.column(c)[r] += share.entry(r, c);
  };

  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const bool first_moves = plan.inverse_mass[i] != 0.0, second_moves = plan.inverse_mass[j] != 0.0;
    if (!first_moves && !second_moves) return;
    const auto share = share_of<Dimensions>(plan, b, i, j, s, x, v, curvature);
    if (first_moves) add(diagonal_[i], share);
    if (second_moves) add(diagonal_[j], share);
    if (!first_moves || !second_moves) return;
    for (int c = 0; c < Dimensions; ++c)
      for (int r = 0; r < Dimensions; ++r) coupling_[s].column(c)[r] -= share.entry(r, c);
  });
}

void StiffnessMatrix::assemble(const Plan& plan, double b, const Field& x, const Field& v, Curvature curvature) {
  solver_.set_zero();
  for (Index i = 0; i < plan.points; ++i) {
    const bool pulled = plan.pull && plan.pull->point == i && plan.inverse_mass[i] != 0.0;
    const double diagonal = plan.mass[i] * (1.0 + b * plan.drag) + (pulled ? b * b * plan.pull->stiffness : 0.0);
    for (int c = 0; c < plan.dimensions; ++c) diagonal_[i].column(c)[c] += diagonal;
  }
  if (plan.dimensions == 2)
    add_springs<2>(plan, b, x.data(), v.data(), curvature);
  else
    add_springs<3>(plan, b, x.data(), v.data(), curvature);
}

}  // namespace hooke
