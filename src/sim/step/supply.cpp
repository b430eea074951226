#include "sim/step/supply.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/step/constants.h"

namespace hooke {

double max_length(const std::vector<Vec3>& vectors) {
  double max = 0.0;
  for (const Vec3& v : vectors) max = std::max(max, glm::dot(v, v));
  return std::sqrt(max);
}

double mass_of(const System& system) {
  double mass = 0.0;
  for (const Point& point : system.points()) mass += point.mass;
  return mass;
}

namespace {

// The minimum of the supplied energy [J]: M g L; without gravity, a part of sum k l0^2; where only listed forces act, of M (w L)^2; what
// muscles store when they contract, k (a l0)^2 / 2.
double min_scale(const System& system, const State& state) {
  double springs = 0.0, muscles = 0.0;
  for (const Spring& spring : system.springs()) {
    const double elastic = system.stiffness_of(spring) * spring.rest_length * spring.rest_length;
    springs += elastic;
    if (spring.law) muscles += 0.5 * elastic * spring.law->amplitude * spring.law->amplitude;
  }
  const double w = system.forces.empty() ? 0.0 : bound_spectrum(system).force_omega, distance = max_length(state.position);
  const bool is_known = std::isfinite(w) && std::isfinite(distance);
  const double forces = is_known ? min_force_scale * mass_of(system) * w * w * distance * distance : 0.0;
  return std::max({reference_energy(system, state), min_elastic_scale * springs, forces, muscles, 1e-300});
}

void record_extent(State& state) {
  state.supply.extent = std::max(state.supply.extent.value_or(0.0), max_length(state.position));
  state.supply.speed = std::max(state.supply.speed.value_or(0.0), max_length(state.velocity));
}

}  // namespace

void initialize_supply(const System& system, State& state) { initialize_supply(system, compute_energy(system, state), state); }

void initialize_supply(const System& system, const Energy& energy, State& state) {
  state.supply = {.net_input = energy.total()};
  state.supply.scale = std::max(energy.kinetic + energy.elastic, min_scale(system, state));
  record_extent(state);
}

void record_edit_energy(const System& system, double change, State& state) {
  state.supply.net_input += change;
  state.supply.scale = std::max(state.supply.scale + std::abs(change), min_scale(system, state));
  record_extent(state);
}

// What drag, dashpots and contact dissipate was present before: counted as supplied, it would hide a divergence that feeds on it.
void record_frame_energy(const Plan& plan, const EnergyLedger& frame, const HandMotion& hand, State& state) {
  using enum EnergyCause;
  EnergySupply& supply = state.supply;
  for (const EnergyCause cause : {Colliders, Breaks, StrainLimit, Forces}) {
    supply.net_input += frame[cause];
    supply.scale += std::max(0.0, frame[cause]);
  }
  supply.add_reversible(frame[Potentials]);
  // what moves back and forth supplies energy and takes it back
  for (const EnergyCause cause : {Hand, Muscles}) {
    supply.net_input += frame[cause];
    supply.scale += std::abs(frame[cause]);
  }
  supply.hand_stretch = std::max(supply.hand_stretch, hand.stretch);
  if (!supply.extent || !(plan.hand.held || plan.hand.pull || plan.collider_paths.grabbed)) return;
  const double distance = state.hand.collider ? glm::length(anchor_of(state.hand.collider->shape)) : 0.0;
  supply.extent = std::max({*supply.extent, glm::length(hand.target), distance});
  supply.speed = std::max(supply.speed.value_or(0.0), hand.speed);
}

}  // namespace hooke
