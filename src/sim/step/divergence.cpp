#include "sim/step/divergence.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/finite.h"
#include "sim/plan/plan.h"
#include "sim/step/constants.h"

namespace hooke {
namespace {

// Bound on the fastest rate of each point [1/s^2]: the stiffness of its springs over its mass (as in bound_spectrum).
std::vector<double> stiffness_rates(const System& system) {
  std::vector<double> rate(system.points().size(), 0.0);
  for (const Spring& spring : system.springs())
    for (const PointId id : {spring.first, spring.second}) {
      const Index i = system.index_of(id);
      rate[i] += system.stiffness_bound_of(spring) / system.points()[i].mass;
    }
  return rate;
}

// The fastest free point. Non-finite values spread along the springs within a frame, so the order of the points has no meaning then: the
// point among them that its springs can accelerate most.
Index worst_point(const System& system, const State& state) {
  const auto is_lost = [&](Index i) { return !is_finite(state.position[i]) || !is_finite(state.velocity[i]); };
  bool any_lost = false;
  for (Index i = 0; i < system.point_count(); ++i) any_lost = any_lost || is_lost(i);
  const std::vector<double> rate = any_lost ? stiffness_rates(system) : std::vector<double>();

  Index worst = no_index;
  double highest = -2.0;  // nailed points only where there are no others
  for (Index i = 0; i < system.point_count(); ++i) {
    if (any_lost && !is_lost(i)) continue;
    const double badness = system.points()[i].nailed ? (any_lost ? -0.5 : -1.0) : any_lost ? rate[i] : glm::length(state.velocity[i]);
    if (!(badness > highest)) continue;
    highest = badness;
    worst = i;
  }
  return worst;
}

// The spring with the highest elastic energy, among those on the worst point if there are any.
Index worst_spring(const System& system, const State& state, Index point) {
  Index worst = no_index;
  bool worst_is_on_point = false;
  double highest = -1.0;
  for (Index s = 0; s < system.spring_count(); ++s) {
    const Spring& spring = system.springs()[s];
    const bool on_point = point != no_index && (spring.first == system.points()[point].id || spring.second == system.points()[point].id);
    if (worst_is_on_point && !on_point) continue;
    const double extension = strain(system, state, spring) * std::max(spring.rest_length, 1e-300);
    const double energy = std::isfinite(extension) ? system.stiffness_of(spring) * extension * extension : INFINITY;
    if (energy > highest || (on_point && !worst_is_on_point)) {
      highest = energy;
      worst = s;
      worst_is_on_point = on_point;
    }
  }
  return worst;
}

Divergence::Kind kind_of(StepFailure failure) {
  switch (failure) {
    case StepFailure::TooShort:
      return Divergence::Kind::StepTooShort;
    case StepFailure::TooMany:
      return Divergence::Kind::TooManySteps;
    case StepFailure::MatrixTooLarge:
      return Divergence::Kind::MatrixTooLarge;
    default:
      return Divergence::Kind::TooManyPairs;
  }
}

}  // namespace

bool is_finite(const State& state) {
  // 0 x is zero for finite x and NaN otherwise: one sum without branches
  double sum = 0.0;
  for (const Vec3& x : state.position) sum += 0.0 * x.x + 0.0 * x.y + 0.0 * x.z;
  for (const Vec3& v : state.velocity) sum += 0.0 * v.x + 0.0 * v.y + 0.0 * v.z;
  return sum == 0.0;
}

namespace {

// The kinetic energy [J] that listed forces, by their bounds where the scene started, cause within a tenth of a second. Explicit Euler
// starts from rest without displacement: its first step gains energy before the forces have done any work. 0 once those with
// a potential have.
double energy_of_a_start(const System& system, const State& state) {
  if (system.forces.empty() || !state.supply.extent || !state.supply.speed) return 0.0;
  if (state.supply.min_reversible.value_or(0.0) != state.supply.max_reversible.value_or(0.0)) return 0.0;
  const double extent = *state.supply.extent, speed = *state.supply.speed, time = std::min(max_start_time, std::abs(state.time));
  const Spectrum s = bound_spectrum(system, speed);
  const double of_positions = (s.force_omega * s.force_omega + s.estimated_omega * s.estimated_omega) * extent;
  const double of_velocities = (s.force_rate + s.estimated_rate) * (speed + s.force_speed);
  const double driven = std::isfinite(s.force_acceleration) ? s.force_acceleration : 0.0;
  const double gained = time * (of_positions + of_velocities + driven);
  return std::isfinite(gained) ? 0.5 * mass_of(system) * gained * gained : 0.0;
}

// Whether a point is farther away than any motion can have taken it.
bool is_implausible(const System& system, const State& state, double distance) {
  const EnergySupply& supply = state.supply;
  if (!supply.extent || !supply.speed || distance <= implausible_factor * *supply.extent) return false;
  return distance > plausible_reach(system, bound_spectrum(system), *supply.extent, *supply.speed, std::abs(state.time));
}

}  // namespace

std::optional<Divergence> find_divergence(const System& system, const State& state, const Energy& energy, StepFailure failure) {
  Divergence divergence{.time = state.time, .scale = state.supply.scale};

  // moving air accelerates points up to its speed
  if (system.drag_rate() > 0.0) divergence.scale += mass_of(system) * glm::dot(system.wind, system.wind);

  divergence.energy = energy.total() - state.supply.net_input;
  const double present = energy.kinetic + energy.elastic;
  // the work of a force may overflow before the state does
  if (!is_finite(state) || !std::isfinite(divergence.energy) || !std::isfinite(divergence.scale))
    divergence.kind = Divergence::Kind::NotFinite;
  else if (failure != StepFailure::None)
    divergence.kind = kind_of(failure);
  else if (divergence.energy > divergence_factor * divergence.scale + state.supply.hand_stretch &&
           divergence.energy > divergence_fraction * present && divergence.energy > energy_of_a_start(system, state))
    divergence.kind = Divergence::Kind::EnergyGain;
  else if (divergence.distance = max_length(state.position); is_implausible(system, state, divergence.distance))
    divergence.kind = Divergence::Kind::Implausible;
  else
    return std::nullopt;

  const Index point = worst_point(system, state);
  if (point != no_index) divergence.point = system.points()[point].id;
  const Index spring = worst_spring(system, state, point);
  if (spring != no_index) divergence.spring = system.springs()[spring].id;
  return divergence;
}

}  // namespace hooke
