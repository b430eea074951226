#include "sim/methods/implicit/stiffness.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "sim/forces/field_kernel.h"
#include "sim/forces/spring_laws.h"

namespace hooke {
namespace {

template <class Use>
void for_each_spring(const Plan& plan, const Use& use) {
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) use(run.first + e, run.second + e, run.begin + e);
}

// On and above the diagonal: use(row, column, entry).
template <class Use>
void for_each_hinge_entry(const Plan& plan, const Use& use) {
  const HingePlan& hinges = plan.force_data.hinges;
  for (Index i = 0; !hinges.empty() && i < plan.points; ++i)
    for (Index k = hinges.begin[i]; k < hinges.begin[i + 1]; ++k)
      if (hinges.column[k] >= i) use(i, hinges.column[k], k);
}

std::vector<std::pair<Index, Index>> couplings_of(const Plan& plan) {
  std::vector<std::pair<Index, Index>> pairs;
  pairs.reserve(plan.springs);
  for_each_spring(plan, [&](Index i, Index j, Index) { pairs.emplace_back(i, j); });
  for_each_hinge_entry(plan, [&](Index i, Index j, Index) {
    if (i != j) pairs.emplace_back(i, j);
  });
  for (const auto& [i, j] : plan.force_data.enclosures.edges) pairs.emplace_back(i, j);
  return pairs;
}

// The contribution of a spring to the matrix: along u u^T + across I, `along` being the difference of both stiffnesses.
template <int Dimensions>
struct SpringContribution {
  double u[Dimensions];
  double uniaxial, isotropic;

  double entry(int r, int c) const { return uniaxial * u[r] * u[c] + (r == c ? isotropic : 0.0); }
};

template <int Dimensions>
SpringContribution<Dimensions> spring_contribution(const Plan& plan, double time, double b, Index i, Index j, Index s, const double* x,
                                                   const double* v, Curvature curvature) {
  const std::size_t n = plan.points;
  SpringContribution<Dimensions> contribution;
  double length_squared = 0.0, approach = 0.0;
  for (int c = 0; c < Dimensions; ++c) {
    contribution.u[c] = x[c * n + i] - x[c * n + j];
    length_squared += contribution.u[c] * contribution.u[c];
    approach += contribution.u[c] * (v[c * n + i] - v[c * n + j]);
  }
  const double length = std::sqrt(length_squared);
  const auto [of, d] = response_of(plan, s, time, length);
  if (length == 0.0) {
    contribution.uniaxial = 0.0;
    contribution.isotropic = b * b * of.stiffness;
    return contribution;
  }

  for (double& component : contribution.u) component /= length;
  const double tension = of.tension + d * approach / length;
  contribution.isotropic = b * b * tension / length;
  if (curvature == Curvature::Clamped) contribution.isotropic = std::max(0.0, contribution.isotropic);
  contribution.uniaxial = b * (b * of.stiffness + d) - contribution.isotropic;
  return contribution;
}

}  // namespace

StiffnessMatrix::StiffnessMatrix(const Plan& plan)
    : solver_(plan.points, plan.dimensions, couplings_of(plan)), dimensions_(plan.dimensions) {
  for (Index i = 0; i < plan.points; ++i) diagonal_.push_back(solver_.diagonal(i));
  coupling_.resize(plan.springs);
  for_each_spring(plan, [&](Index i, Index j, Index s) { coupling_[s] = solver_.coupling(i, j); });
  hinges_.resize(plan.force_data.hinges.column.size());
  for_each_hinge_entry(plan, [&](Index i, Index j, Index k) { hinges_[k] = i == j ? diagonal_[i] : solver_.coupling(i, j); });
  for (const auto& [i, j] : plan.force_data.enclosures.edges) enclosure_edges_.push_back(solver_.coupling(i, j));
}

void StiffnessMatrix::add_hinges(const Plan& plan, double b, Curvature curvature) {
  for_each_hinge_entry(plan, [&](Index i, Index j, Index k) {
    if (plan.inverse_mass[i] == 0.0 || plan.inverse_mass[j] == 0.0) return;
    const double stiffness = b * b * tangent_.hinge_stiffness() * plan.force_data.hinges.value[k];
    const bool is_transposed = i != j && !solver_.precedes(i, j);
    for (int c = 0; c < plan.dimensions; ++c) hinges_[k].column(c)[c] += stiffness;
    if (!tangent_.have_hinges_blocks()) return;
    const glm::dmat3 block = tangent_.hinge_block(k, b, curvature == Curvature::Exact);
    for (int c = 0; c < plan.dimensions; ++c)
      for (int r = 0; r < (i == j ? c + 1 : plan.dimensions); ++r) hinges_[k].column(c)[r] += is_transposed ? block[r][c] : block[c][r];
  });
}

void StiffnessMatrix::add_volume_curvature(const Plan& plan, double b) {
  for (std::size_t e = 0; e < enclosure_edges_.size(); ++e) {
    const auto& [i, j] = plan.force_data.enclosures.edges[e];
    if (plan.inverse_mass[i] == 0.0 || plan.inverse_mass[j] == 0.0) continue;
    // the transpose of w x is -w x
    const Vec3 w = (solver_.precedes(i, j) ? 1.0 : -1.0) * b * b * tangent_.volume_curvature(e);
    const double product[3][3] = {{0.0, -w.z, w.y}, {w.z, 0.0, -w.x}, {-w.y, w.x, 0.0}};
    for (int c = 0; c < plan.dimensions; ++c)
      for (int r = 0; r < plan.dimensions; ++r) enclosure_edges_[e].column(c)[r] += product[r][c];
  }
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
    const auto contribution = spring_contribution<Dimensions>(plan, time_, b, i, j, s, x, v, curvature);
    if (first_moves) add(diagonal_[i], contribution);
    if (second_moves) add(diagonal_[j], contribution);
    if (!first_moves || !second_moves) return;
    for (int c = 0; c < Dimensions; ++c)
      for (int r = 0; r < Dimensions; ++r) coupling_[s].column(c)[r] -= contribution.entry(r, c);
  });
}

void StiffnessMatrix::allocate(const Plan& plan) {
  has_pull_update_ = plan.hand.pull && plan.hand.pull->count > 1;
  has_forces_ = !plan.forces.empty();
  is_linearized_ = false;
  updates_.resize((has_pull_update_ ? 1 : 0) + (has_forces_ ? 1 : 0));
  for (Update& update : updates_) {
    update.parts.reserve(plan.points);
    for (int c = 0; c < plan.dimensions; ++c) update.response[c].resize(static_cast<std::size_t>(plan.points) * plan.dimensions);
  }
  const std::size_t size = static_cast<std::size_t>(plan.points) * plan.dimensions;
  volume_updates_.resize(plan.force_data.enclosures.enclosures.size());
  for (VolumeUpdate& update : volume_updates_) {
    update.weight = 0.0;
    update.gradient.resize(size);
    update.response.resize(size);
  }
  if (has_forces_) tangent_.reset(plan);
}

void StiffnessMatrix::linearize_forces(const Plan& plan, double time, const Field& x, const Field& v) {
  time_ = time;
  if (!has_forces_) return;
  tangent_.reset(plan);
  is_linearized_ = true;
  for (const Force& force : plan.forces)
    if (force.term->add_tangent != nullptr) force.term->add_tangent(plan, force.values, time, x.data(), v.data(), tangent_);
}

void StiffnessMatrix::add_force_damping(const Plan& plan, double scale, const Field& v, Field& result) const {
  if (!is_linearized_) return;
  const std::size_t n = plan.points;
  Vec3 momentum(0.0);
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0; i < n; ++i)
      if (plan.inverse_mass[i] != 0.0) momentum[c] += plan.mass[i] * v[c * n + i];
  for (std::size_t i = 0; i < n; ++i) {
    if (plan.inverse_mass[i] == 0.0) continue;
    Vec3 velocity(0.0);
    for (int c = 0; c < plan.dimensions; ++c) velocity[c] = v[c * n + i];
    const Vec3 force = tangent_.damping(static_cast<Index>(i)) * velocity + plan.mass[i] * tangent_.mean_damping() * momentum;
    for (int c = 0; c < plan.dimensions; ++c) result[c * n + i] += scale * force[c];
  }
  if (!tangent_.are_hinges_damped()) return;
  for_each_hinge_entry(plan, [&](Index i, Index j, Index k) {
    if (plan.inverse_mass[i] == 0.0 || plan.inverse_mass[j] == 0.0) return;
    const glm::dmat3& damping = tangent_.hinge_damping(k);
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) {
        result[r * n + i] += scale * damping[c][r] * v[c * n + j];
        if (i != j) result[c * n + j] += scale * damping[c][r] * v[r * n + i];
      }
  });
}

void StiffnessMatrix::assemble(const Plan& plan, double b, const Field& x, const Field& v, Curvature curvature) {
  solver_.set_zero();
  for (Index i = 0; i < plan.points; ++i) {
    const bool pulled = plan.hand.pull && plan.hand.pull->count == 1 && plan.hand.pull->parts[0].point == i && plan.inverse_mass[i] != 0.0;
    const double diagonal = plan.mass[i] * (1.0 + b * plan.drag) + (pulled ? b * b * plan.hand.pull->stiffness : 0.0);
    for (int c = 0; c < plan.dimensions; ++c) diagonal_[i].column(c)[c] += diagonal;
    if (!is_linearized_ || plan.inverse_mass[i] == 0.0) continue;
    const glm::dmat3 block = tangent_.block(i, b);
    for (int c = 0; c < plan.dimensions; ++c)
      for (int r = 0; r <= c; ++r) diagonal_[i].column(c)[r] += block[c][r];
  }

  if (is_linearized_) {
    add_hinges(plan, b, curvature);
    if (curvature == Curvature::Exact) add_volume_curvature(plan, b);
  }
  for (std::size_t u = 0; u < volume_updates_.size(); ++u) {
    VolumeUpdate& update = volume_updates_[u];
    update.weight = is_linearized_ ? b * b * tangent_.volume(u).stiffness : 0.0;
    if (update.weight == 0.0) continue;
    const Field& gradient = tangent_.volume(u).gradient;
    for (std::size_t at = 0; at < gradient.size(); ++at)
      update.gradient[at] = plan.inverse_mass[at % static_cast<std::size_t>(plan.points)] == 0.0 ? 0.0 : gradient[at];
  }
  if (has_pull_update_) {
    Update& update = updates_.front();
    update.weight = b * b * plan.hand.pull->stiffness;
    update.parts.clear();
    for (const auto& [point, weight] : plan.hand.pull->points())
      update.parts.push_back({point, plan.inverse_mass[point] == 0.0 ? 0.0 : weight});
  }
  if (has_forces_) {
    Update& update = updates_.back();
    update.weight = is_linearized_ ? tangent_.mean(b) : 0.0;
    update.parts.clear();
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] != 0.0) update.parts.push_back({i, plan.mass[i]});
  }

  if (plan.dimensions == 2)
    add_springs<2>(plan, b, x.data(), v.data(), curvature);
  else
    add_springs<3>(plan, b, x.data(), v.data(), curvature);
}

// S^T x
glm::dvec3 StiffnessMatrix::Update::project(const double* field, std::size_t points, int dimensions) const {
  glm::dvec3 sum(0.0);
  for (int c = 0; c < dimensions; ++c)
    for (const auto& [point, weight_of_point] : parts) sum[c] += weight_of_point * field[c * points + point];
  return sum;
}

// b = b - Z G S^T b
void StiffnessMatrix::apply(const Update& update, Field& b) const {
  const glm::dvec3 correction = update.gain * update.project(b.data(), diagonal_.size(), dimensions_);
  for (int c = 0; c < dimensions_; ++c) add_scaled(b.data(), -correction[c], update.response[c].data(), b.size());
}

// b = b - z gain g.b
void StiffnessMatrix::apply(const VolumeUpdate& update, Field& b) {
  double product = 0.0;
  for (std::size_t at = 0; at < b.size(); ++at) product += update.gradient[at] * b[at];
  add_scaled(b.data(), -update.gain * product, update.response.data(), b.size());
}

bool StiffnessMatrix::factorize() {
  if (!solver_.factorize()) return false;
  const std::size_t n = diagonal_.size();
  for (std::size_t u = 0; u < updates_.size(); ++u) {
    Update& update = updates_[u];
    if (update.weight == 0.0) continue;
    glm::dmat3 unit(1.0);
    for (int c = 0; c < dimensions_; ++c) {
      Field& z = update.response[c];
      std::fill(z.begin(), z.end(), 0.0);
      for (const auto& [point, weight] : update.parts) z[c * n + point] += weight;
      solver_.solve(z);
      for (std::size_t earlier = 0; earlier < u; ++earlier)
        if (updates_[earlier].weight != 0.0) apply(updates_[earlier], z);
      const glm::dvec3 projection = update.project(z.data(), n, dimensions_);
      for (int r = 0; r < dimensions_; ++r) unit[c][r] += update.weight * projection[r];
    }
    update.gain = update.weight * glm::inverse(unit);
  }
  for (std::size_t u = 0; u < volume_updates_.size(); ++u) {
    VolumeUpdate& update = volume_updates_[u];
    if (update.weight == 0.0) continue;
    update.response = update.gradient;
    solver_.solve(update.response);
    for (const Update& earlier : updates_)
      if (earlier.weight != 0.0) apply(earlier, update.response);
    for (std::size_t earlier = 0; earlier < u; ++earlier)
      if (volume_updates_[earlier].weight != 0.0) apply(volume_updates_[earlier], update.response);
    double product = 0.0;
    for (std::size_t at = 0; at < update.gradient.size(); ++at) product += update.gradient[at] * update.response[at];
    update.gain = update.weight / (1.0 + update.weight * product);
  }
  return true;
}

void StiffnessMatrix::solve(Field& b) {
  solver_.solve(b);
  for (const Update& update : updates_)
    if (update.weight != 0.0) apply(update, b);
  for (const VolumeUpdate& update : volume_updates_)
    if (update.weight != 0.0) apply(update, b);
}

}  // namespace hooke
