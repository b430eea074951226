#include "sim/forces/energy/plan_energy.h"

#include <algorithm>
#include <cmath>

#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"
#include "sim/forces/spring_laws.h"

namespace hooke {

double stored_energy(const Plan& plan, double time, const Field& x) {
  double energy = law_energy(plan, time, x);
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] != 0.0) energy -= plan.mass[i] * plan.gravity[c] * x[static_cast<std::size_t>(c) * plan.points + i];
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) {
      double length_squared = 0.0;
      for (int c = 0; c < plan.dimensions; ++c) {
        const double* at = x.data() + static_cast<std::size_t>(c) * plan.points;
        const double difference = at[run.second + e] - at[run.first + e];
        length_squared += difference * difference;
      }
      const double stretch = std::sqrt(length_squared) - plan.spring.rest_length[run.begin + e];
      energy += 0.5 * plan.spring.stiffness[run.begin + e] * stretch * stretch;
    }
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
  double power = law_dashpot_power(plan, time, x, v);
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) {
      const double damping = plan.spring.damping[run.begin + e];
      if (damping == 0.0) continue;
      double length_squared = 0.0, product = 0.0;
      for (int c = 0; c < plan.dimensions; ++c) {
        const std::size_t at = static_cast<std::size_t>(c) * plan.points, i = at + run.first + e, j = at + run.second + e;
        length_squared += (x[j] - x[i]) * (x[j] - x[i]);
        product += (x[j] - x[i]) * (v[j] - v[i]);
      }
      if (length_squared > 0.0) power += damping * product * product / length_squared;
    }
  return power;
}

double max_dissipation(const Spectrum& spectrum, double supplied, double kinetic, double duration) {
  return 2.0 * (spectrum.drag_rate + spectrum.dashpot_rate) * std::max(supplied, 2.0 * kinetic) * duration;
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
