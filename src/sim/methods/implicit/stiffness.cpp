#include "sim/methods/implicit/stiffness.h"

#include <algorithm>
#include <span>

#include "sim/forces/field_kernel.h"
#include "sim/forces/motion.h"

namespace hooke {
namespace {

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

}  // namespace

StiffnessMatrix::StiffnessMatrix(const Plan& plan) : solver_(plan.points, plan.dimensions, couplings_of(plan)) {
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
    const double stiffness = b * b * tangent_.hinges.stiffness * plan.force_data.hinges.value[k];
    const bool is_transposed = i != j && !solver_.precedes(i, j);
    for (int c = 0; c < plan.dimensions; ++c) hinges_[k].column(c)[c] += stiffness;
    if (!tangent_.hinges.has_blocks()) return;
    const glm::dmat3 block = tangent_.hinges.block(k, b, curvature == Curvature::Exact);
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

void StiffnessMatrix::add_springs(const Plan& plan, double b, const Field& x, const Field& v, Curvature curvature) {
  for_each_spring_tangent(plan, time_, x, &v, curvature, [&](Index i, Index j, Index s, const SpringTangent& tangent) {
    const double isotropic = b * b * tangent.transverse, uniaxial = b * (b * tangent.axial + tangent.damping) - isotropic;
    const bool first_moves = plan.inverse_mass[i] != 0.0, second_moves = plan.inverse_mass[j] != 0.0;
    for (int c = 0; c < plan.dimensions; ++c)
      for (int r = 0; r < plan.dimensions; ++r) {
        const double entry = uniaxial * tangent.u[r] * tangent.u[c] + (r == c ? isotropic : 0.0);
        if (first_moves && r <= c) diagonal_[i].column(c)[r] += entry;
        if (second_moves && r <= c) diagonal_[j].column(c)[r] += entry;
        if (first_moves && second_moves) coupling_[s].column(c)[r] -= entry;
      }
  });
}

void StiffnessMatrix::allocate(const Plan& plan) {
  is_linearized_ = false;
  // of the pull, and of forces on the center of mass, one for each component
  updates_.resize(2 * static_cast<std::size_t>(plan.dimensions) + plan.force_data.enclosures.enclosures.size());
  for (Update& update : updates_) update.weight = 0.0;
  const bool has_pull = plan.hand.pull && plan.hand.pull->count > 1;
  const std::size_t size = static_cast<std::size_t>(plan.points) * plan.dimensions;
  for (std::size_t u = 0; u < updates_.size(); ++u) {
    if (u < static_cast<std::size_t>(plan.dimensions) ? !has_pull : plan.forces.empty()) continue;
    updates_[u].vector.resize(size);
    updates_[u].response.resize(size);
  }
  if (!plan.forces.empty()) tangent_.reset(plan);
}

void StiffnessMatrix::linearize_forces(const Plan& plan, double time, const Field& x, const Field& v) {
  time_ = time;
  if (plan.forces.empty()) return;
  tangent_.reset(plan);
  is_linearized_ = true;
  for (const Force& force : plan.forces)
    if (force.term->add_tangent != nullptr) force.term->add_tangent(plan, force.values, time, x.data(), v.data(), tangent_);
}

void StiffnessMatrix::add_force_damping(const Plan& plan, double scale, const Field& v, Field& result) const {
  if (!is_linearized_) return;
  const auto is_free = [&](Index i) { return plan.inverse_mass[i] != 0.0; };
  Vec3 momentum(0.0);
  for (Index i = 0; i < plan.points; ++i)
    if (is_free(i)) momentum += plan.mass[i] * vector_at(plan, v, i);
  for (Index i = 0; i < plan.points; ++i)
    if (is_free(i))
      add_vector(plan, result, i,
                 scale * (tangent_.damping(i) * vector_at(plan, v, i) + plan.mass[i] * tangent_.mean_damping() * momentum));
  if (!tangent_.hinges.is_damped()) return;
  for_each_hinge_entry(plan, [&](Index i, Index j, Index k) {
    if (!is_free(i) || !is_free(j)) return;
    const glm::dmat3& damping = tangent_.hinges.damping(k);
    add_vector(plan, result, i, scale * (damping * vector_at(plan, v, j)));
    if (i != j) add_vector(plan, result, j, scale * (vector_at(plan, v, i) * damping));
  });
}

void StiffnessMatrix::assemble(const Plan& plan, double b, const Field& x, const Field& v, Curvature curvature) {
  solver_.set_zero();
  for (Index i = 0; i < plan.points; ++i) {
    const bool pulled = plan.hand.pull && plan.hand.pull->count == 1 && plan.hand.pull->parts[0].point == i && plan.inverse_mass[i] != 0.0;
    const double diagonal = plan.mass[i] * (1.0 + b * plan.drag) + (pulled ? b * b * plan.hand.pull->stiffness : 0.0);
    for (int c = 0; c < plan.dimensions; ++c) diagonal_[i].column(c)[c] += diagonal + fixed_mass(plan, i, c);
    if (!is_linearized_ || plan.inverse_mass[i] == 0.0) continue;
    const glm::dmat3 block = tangent_.block(i, b);
    for (int c = 0; c < plan.dimensions; ++c)
      for (int r = 0; r <= c; ++r) diagonal_[i].column(c)[r] += block[c][r];
  }

  if (is_linearized_) {
    add_hinges(plan, b, curvature);
    if (curvature == Curvature::Exact) add_volume_curvature(plan, b);
  }
  set_updates(plan, b);
  add_springs(plan, b, x, v, curvature);
}

// The vectors of the updates: zero for points that do not move freely.
void StiffnessMatrix::set_updates(const Plan& plan, double b) {
  if (updates_.empty()) return;
  const std::size_t n = plan.points, dimensions = plan.dimensions;
  const auto set_component = [&](Update& update, std::size_t c, double weight, const auto& set) {
    update.weight = weight;
    if (weight == 0.0) return;
    std::ranges::fill(update.vector, 0.0);
    set(update.vector.data() + c * n);
  };
  const bool has_pull = plan.hand.pull && plan.hand.pull->count > 1;
  for (std::size_t c = 0; c < dimensions; ++c) {
    set_component(updates_[c], c, has_pull ? b * b * plan.hand.pull->stiffness : 0.0, [&](double* vector) {
      for (const auto& [point, weight] : plan.hand.pull->points()) vector[point] = plan.inverse_mass[point] == 0.0 ? 0.0 : weight;
    });
    set_component(updates_[dimensions + c], c, is_linearized_ ? tangent_.mean(b) : 0.0, [&](double* vector) {
      for (std::size_t i = 0; i < n; ++i) vector[i] = plan.inverse_mass[i] == 0.0 ? 0.0 : plan.mass[i];
    });
  }
  for (std::size_t e = 0; e < plan.force_data.enclosures.enclosures.size(); ++e) {
    Update& update = updates_[2 * dimensions + e];
    update.weight = is_linearized_ ? b * b * tangent_.volume(e).stiffness : 0.0;
    if (update.weight == 0.0) continue;
    const Field& gradient = tangent_.volume(e).gradient;
    for (std::size_t at = 0; at < gradient.size(); ++at) update.vector[at] = plan.inverse_mass[at % n] == 0.0 ? 0.0 : gradient[at];
  }
}

// r = r - z gain s.r, of the first `count` updates
void StiffnessMatrix::apply_updates(std::size_t count, Field& r) const {
  for (const Update& update : std::span(updates_).first(count))
    if (update.weight != 0.0) add_scaled(r.data(), -update.gain * dot(update.vector, r), update.response.data(), r.size());
}

bool StiffnessMatrix::factorize() {
  if (!solver_.factorize()) return false;
  for (std::size_t u = 0; u < updates_.size(); ++u) {
    Update& update = updates_[u];
    if (update.weight == 0.0) continue;
    std::ranges::copy(update.vector, update.response.begin());
    solver_.solve(update.response);
    apply_updates(u, update.response);
    update.gain = update.weight / (1.0 + update.weight * dot(update.vector, update.response));
  }
  return true;
}

void StiffnessMatrix::solve(Field& b) {
  solver_.solve(b);
  apply_updates(updates_.size(), b);
}

}  // namespace hooke
