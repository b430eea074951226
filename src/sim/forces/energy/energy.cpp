#include "sim/forces/energy/energy.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hooke {
SpringResponse response_at(const System& system, const State& state, const Spring& spring) {
  const double length = glm::distance(state.position[system.index_of(spring.first)], state.position[system.index_of(spring.second)]);
  const double extension = length - system.rest_length_of(spring, state.time);
  static constexpr SpringLaw linear;
  return response_of(spring.law ? *spring.law : linear, system.stiffness_of(spring), extension);
}

Energy compute_energy(const System& system, const State& state) {
  Energy energy{.kinetic = kinetic_energy(system, state)};
  for (Index i = 0; i < system.point_count(); ++i) {
    const Point& point = system.points()[i];
    if (point.nailed) continue;
    energy.gravitational -= point.mass * glm::dot(system.gravity, state.position[i]);
  }
  for (const Spring& spring : system.springs()) energy.elastic += elastic_energy(system, state, spring);
  if (system.grab && system.grab->kind == GrabKind::Pull) {
    const Vec3 stretch = state.hand.position - grabbed_position(system, state);
    energy.elastic += 0.5 * system.grab->stiffness * glm::dot(stretch, stretch);
  }
  return energy;
}

double kinetic_energy(const System& system, const State& state) {
  double energy = 0.0;
  for (Index i = 0; i < system.point_count(); ++i) {
    const Vec3 v = velocity_of(system.points()[i], state.velocity[i]);
    energy += 0.5 * system.points()[i].mass * glm::dot(v, v);
  }
  return energy;
}

double elastic_energy(const System& system, const State& state, const Spring& spring) { return response_at(system, state, spring).energy; }
double tension(const System& system, const State& state, const Spring& spring) { return response_at(system, state, spring).tension; }

Momentum compute_momentum(const System& system, const State& state) {
  Momentum momentum;
  for (Index i = 0; i < system.point_count(); ++i) {
    if (system.points()[i].nailed) continue;
    const Vec3 p = system.points()[i].mass * velocity_of(system.points()[i], state.velocity[i]);
    momentum.linear += p;
    momentum.angular += glm::cross(state.position[i], p);
  }
  return momentum;
}

double strain(const System& system, const State& state, const Spring& spring) {
  const double length = glm::distance(state.position[system.index_of(spring.first)], state.position[system.index_of(spring.second)]);
  const double rest_length = system.rest_length_of(spring, state.time);
  return rest_length > 0.0 ? length / rest_length - 1.0 : length;
}

bool can_collapse(const System& system, const State& state) {
  return std::ranges::any_of(system.springs(), [&](const Spring& spring) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const Point &first = system.points()[i], &second = system.points()[j];
    const double inverse_mass = (first.nailed ? 0.0 : 1.0 / first.mass) + (second.nailed ? 0.0 : 1.0 / second.mass);
    const double omega_squared = system.stiffness_bound_of(spring) * inverse_mass;
    if (!(omega_squared > 0.0) || spring.rest_length == 0.0) return false;
    const double extension = glm::distance(state.position[i], state.position[j]) - spring.rest_length;
    const Vec3 velocity = (second.nailed ? Vec3(0.0) : state.velocity[j]) - (first.nailed ? Vec3(0.0) : state.velocity[i]);
    return extension * extension + glm::dot(velocity, velocity) / omega_squared >= spring.rest_length * spring.rest_length;
  });
}

Vec3 grabbed_position(const System& system, const State& state) {
  const Grab& grab = *system.grab;
  if (!grab.patch) return state.position[system.index_of(grab.point)];
  Vec3 place(0.0);
  for (std::size_t p = 0; p < 3; ++p) place += grab.patch->weights[p] * state.position[system.index_of(grab.patch->points[p])];
  return place;
}

double reference_energy(const System& system, const State& state) {
  double mass = 0.0, loads = 0.0, max_rest_length = 0.0;
  Vec3 min(1e300), max(-1e300);
  for (Index i = 0; i < system.point_count(); ++i) {
    min = glm::min(min, state.position[i]);
    max = glm::max(max, state.position[i]);
    if (system.points()[i].nailed) continue;
    mass += system.points()[i].mass;
    loads += glm::length(system.points()[i].load);
  }
  for (const Spring& spring : system.springs()) max_rest_length = std::max(max_rest_length, spring.rest_length);
  const double extent = system.point_count() > 0 ? std::max(glm::distance(min, max), max_rest_length) : 0.0;
  const double size = extent > 0.0 ? extent : 1.0;
  return (mass * glm::length(system.gravity) + loads) * size;
}

}  // namespace hooke
