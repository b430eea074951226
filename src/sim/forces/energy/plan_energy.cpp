#include "sim/forces/energy/plan_energy.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"
#include "sim/forces/spring_laws.h"

namespace hooke {

double stored_energy(const Plan& plan, double time, const Field& x) {
  double energy = 0.0;
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] != 0.0) energy -= plan.mass[i] * plan.gravity[c] * x[static_cast<std::size_t>(c) * plan.points + i];
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const double length = glm::length(difference_at(plan, x, i, j));
    energy += response_of(plan, s, time, length).of.energy;
  });
  return energy;
}

double kinetic_energy(const Plan& plan, const Field& v) {
  double energy = 0.0;
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at)
      if (plan.inverse_mass[i] != 0.0) energy += 0.5 * plan.mass[i] * v[at] * v[at];
  return energy;
}

double potential_energy(const Plan& plan, double time, const Field& x) {
  double energy = stored_energy(plan, time, x);
  for (const Force& force : plan.forces)
    if (force.term->potential != nullptr) energy += force.term->potential(plan, force.values, time, x.data());
  return energy;
}

double mechanical_energy(const Plan& plan, double time, const Motion& motion) {
  return kinetic_energy(plan, motion.v) + potential_energy(plan, time, motion.x);
}

double dashpot_power(const Plan& plan, double time, const Field& x, const Field& v) {
  double power = 0.0;
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const Vec3 along = difference_at(plan, x, i, j);
    const double length = glm::length(along), damping = response_of(plan, s, time, length).damping;
    if (damping == 0.0 || length == 0.0) return;
    const double speed = glm::dot(along, difference_at(plan, v, i, j)) / length;
    power += damping * speed * speed;
  });
  return power;
}

double max_dissipation(const Spectrum& spectrum, double supplied, double kinetic, double duration) {
  return 2.0 * (spectrum.drag_rate + spectrum.dashpot_rate) * std::max(supplied, 2.0 * kinetic) * duration;
}

double air_work(const Plan& plan, const Field& start, const Field& end) {
  const Vec3 acceleration = plan.acceleration - plan.gravity;
  double work = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    if (acceleration[c] == 0.0) continue;
    const std::size_t begin = static_cast<std::size_t>(c) * plan.points;
    double moment = 0.0;
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] != 0.0) moment += plan.mass[i] * (end[begin + i] - start[begin + i]);
    work += acceleration[c] * moment;
  }
  return work;
}

double verlet_energy_difference(const Plan& plan, double time, const Field& x, const Field& v, double h) {
  // not more than three fields: in a large net, these are what a run needs most memory for
  Field moved = x, force_ahead(x.size()), force_behind(x.size());
  add_scaled(moved.data(), h, v.data(), x.size());
  compute_position_forces(plan, time, moved, v, force_ahead);
  std::ranges::copy(x, moved.begin());
  add_scaled(moved.data(), -h, v.data(), x.size());
  compute_position_forces(plan, time, moved, v, force_behind);
  Field& force = moved;
  compute_position_forces(plan, time, x, v, force);
  double difference = 0.0;
  for (std::size_t at = 0; at < x.size(); ++at) {
    const double inverse_mass = plan.inverse_mass[at % static_cast<std::size_t>(plan.points)];
    if (inverse_mass == 0.0) continue;
    difference -= h / 24.0 * v[at] * (force_ahead[at] - force_behind[at]) + h * h / 24.0 * inverse_mass * force[at] * force[at];
  }
  return difference;
}

}  // namespace hooke
