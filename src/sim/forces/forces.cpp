#include "sim/forces/forces.h"

#include "sim/forces/field_kernel.h"
#include "sim/forces/grid_kernel.h"
#include "sim/forces/spring_kernel.h"
#include "sim/forces/spring_laws.h"

namespace hooke {
namespace {

void set_gravity(const Plan& plan, Field& f) {
  for (int c = 0; c < plan.dimensions; ++c)
    set_scaled(f.data() + static_cast<std::size_t>(c) * plan.points, plan.acceleration[c], plan.mass.data(), plan.mass.size());
}

void add_drag(const Plan& plan, const Field& v, Field& f) {
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * plan.points;
    for (Index i = 0; i < plan.points; ++i) f[begin + i] -= plan.drag * plan.mass[i] * v[begin + i];
  }
}

}  // namespace

bool has_forces_outside_grids(const Plan& plan) {
  return plan.hand.pull || !plan.spring.loose_runs.empty() || !plan.forces.empty() || !plan.spring.laws.empty();
}

// E = k/2 |sum s_i x_i - target|^2, f_i = -k s_i (sum s_j x_j - target)
void add_pull(const Plan& plan, double time, const Field& x, Field& f) {
  const Vec3 stretch = pull_stretch(plan, x, time);
  for (const auto& [point, weight] : plan.hand.pull->points()) add_vector(plan, f, point, -plan.hand.pull->stiffness * weight * stretch);
}

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

double compute_external_forces_with_power(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  set_gravity(plan, f);
  return add_force_terms_with_power(plan, time, x, v, f);
}

void compute_unlisted_forces(const Plan& plan, double time, const Field& x, const Field* v, Field& f) {
  set_gravity(plan, f);
  add_spring_forces(plan, x.data(), v != nullptr ? v->data() : nullptr, f.data());
  add_law_forces(plan, time, x.data(), v != nullptr ? v->data() : nullptr, f.data());
  if (plan.hand.pull) add_pull(plan, time, x, f);
}

void compute_position_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  compute_unlisted_forces(plan, time, x, nullptr, f);
  add_force_terms(plan, time, x, v, f);
}

void compute_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  compute_unlisted_forces(plan, time, x, plan.has_dashpots() ? &v : nullptr, f);
  add_force_terms(plan, time, x, v, f);
  if (plan.drag != 0.0) add_drag(plan, v, f);
}

void compute_accelerations(const Plan& plan, double time, const Field& x, const Field& v, Field& a) {
  if (plan.has_balancing_forces()) {
    compute_forces(plan, time, x, v, a);
    return divide_by_mass(plan, a);
  }
  LeapfrogPass<double> pass = pass_over(plan, x);
  pass.a = a.data();
  if (plan.has_dashpots()) pass.u = v.data();
  if (has_forces_outside_grids(plan) || plan.drag != 0.0) {
    compute_external_forces(plan, time, x, v, a);
    add_loose_spring_forces(plan, x.data(), pass.u, a.data());
    add_law_forces(plan, time, x.data(), pass.u, a.data());
    if (plan.hand.pull) add_pull(plan, time, x, a);
    if (plan.drag != 0.0) add_drag(plan, v, a);
    pass.f = a.data();
  }
  advance(plan, pass, 1);
}

void divide_by_mass(const Plan& plan, Field& f) {
  for (int c = 0; c < plan.dimensions; ++c)
    multiply_each(f.data() + static_cast<std::size_t>(c) * plan.points, plan.inverse_mass.data(), plan.inverse_mass.size());
}

}  // namespace hooke
