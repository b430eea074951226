#include "sim/forces/forces.h"

#include "sim/forces/field_kernel.h"
#include "sim/forces/grid_kernel.h"
#include "sim/forces/spring_kernel.h"

namespace hooke {
namespace {

void set_gravity(const Plan& plan, Field& f) {
  for (int c = 0; c < plan.dimensions; ++c)
    set_scaled(f.data() + static_cast<std::size_t>(c) * plan.points, plan.acceleration[c], plan.mass.data(), plan.mass.size());
}

// E = k/2 |sum s_i x_i - target|^2, f_i = -k s_i (sum s_j x_j - target)
void add_pull(const Plan& plan, double time, const Field& x, Field& f) {
  const Vec3 target = plan.hand.pull->target_at(time);
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * plan.points;
    const double stretch = plan.hand.pull->interpolate(&x[begin]) - target[c];
    for (const auto& [point, weight] : plan.hand.pull->points()) f[begin + point] -= plan.hand.pull->stiffness * weight * stretch;
  }
}

void add_drag(const Plan& plan, const Field& v, Field& f) {
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * plan.points;
    for (Index i = 0; i < plan.points; ++i) f[begin + i] -= plan.drag * plan.mass[i] * v[begin + i];
  }
}

// Points on which no grid acts: f [N] contains all forces, gravity alone if there are no others.
void accelerate_points(const Plan& plan, Index first, Index end, bool has_others, Field& f) {
  const auto count = static_cast<std::size_t>(end - first);
  for (int c = 0; c < plan.dimensions; ++c) {
    double* const component = f.data() + static_cast<std::size_t>(c) * plan.points + first;
    if (!has_others) set_scaled(component, plan.acceleration[c], plan.mass.data() + first, count);
    multiply_each(component, plan.inverse_mass.data() + first, count);
  }
}

}  // namespace

void add_force_terms(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  for (const Force& force : plan.forces) force.term->add(plan, force.values, time, x.data(), v.data(), f.data());
}

double add_force_terms_with_power(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  double power = 0.0;
  for (const Force& force : plan.forces) {
    const ForceTerm& term = *force.term;
    if (term.add_with_power != nullptr) {
      power += term.add_with_power(plan, force.values, time, x.data(), v.data(), f.data());
      continue;
    }
    if (term.power != nullptr) power += term.power(plan, force.values, time, x.data(), v.data());
    term.add(plan, force.values, time, x.data(), v.data(), f.data());
  }
  return power;
}

void compute_external_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  set_gravity(plan, f);
  add_force_terms(plan, time, x, v, f);
}

void add_inner_forces(const Plan& plan, double time, const Field& x, const Field* v, Field& f) {
  add_spring_forces(plan, x.data(), v != nullptr ? v->data() : nullptr, f.data());
  if (plan.hand.pull) add_pull(plan, time, x, f);
}

void compute_unlisted_forces(const Plan& plan, double time, const Field& x, Field& f) {
  set_gravity(plan, f);
  add_inner_forces(plan, time, x, nullptr, f);
}

void compute_position_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  compute_unlisted_forces(plan, time, x, f);
  add_force_terms(plan, time, x, v, f);
}

void compute_network_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  set_gravity(plan, f);
  add_inner_forces(plan, time, x, plan.has_dashpots() ? &v : nullptr, f);
}

void compute_explicit_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  compute_network_forces(plan, time, x, v, f);
  add_force_terms(plan, time, x, v, f);
}

void compute_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  compute_explicit_forces(plan, time, x, v, f);
  if (plan.drag != 0.0) add_drag(plan, v, f);
}

void compute_accelerations(const Plan& plan, double time, const Field& x, const Field& v, Field& a) {
  if (plan.spring.grids.empty() || plan.hand.pull || !plan.forces.empty() || plan.drag != 0.0) {
    compute_forces(plan, time, x, v, a);
    divide_by_mass(plan, a);
    return;
  }
  const double* const velocity = plan.has_dashpots() ? v.data() : nullptr;
  const bool has_others = !plan.spring.loose_runs.empty();
  if (has_others) {
    set_gravity(plan, a);
    add_loose_spring_forces(plan, x.data(), velocity, a.data());
  }
  Index next = 0;
  for (const Grid& grid : plan.spring.grids) {
    accelerate_points(plan, next, grid.first, has_others, a);
    accelerate_grid(plan, grid, x.data(), velocity, has_others ? a.data() : nullptr, a.data());
    next = grid.first + grid.points();
  }
  accelerate_points(plan, next, plan.points, has_others, a);
}

void divide_by_mass(const Plan& plan, Field& f) {
  for (int c = 0; c < plan.dimensions; ++c)
    multiply_each(f.data() + static_cast<std::size_t>(c) * plan.points, plan.inverse_mass.data(), plan.inverse_mass.size());
}

}  // namespace hooke
