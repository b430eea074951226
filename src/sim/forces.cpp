#include "sim/forces.h"

#include <cmath>

#include "sim/field_kernel.h"
#include "sim/spring_kernel.h"

namespace hooke {
namespace {

void set_gravity(const Plan& plan, Field& f) {
  for (int c = 0; c < plan.dimensions; ++c)
    set_scaled(f.data() + static_cast<std::size_t>(c) * plan.points, plan.acceleration[c], plan.mass.data(), plan.mass.size());
}

void add_pull(const Plan& plan, double time, const Field& x, Field& f) {
  const Vec3 target = plan.pull->target_at(time);
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t at = static_cast<std::size_t>(c) * plan.points + plan.pull->point;
    f[at] -= plan.pull->stiffness * (x[at] - target[c]);
  }
}

void add_drag(const Plan& plan, const Field& v, Field& f) {
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * plan.points;
    for (Index i = 0; i < plan.points; ++i) f[begin + i] -= plan.drag * plan.mass[i] * v[begin + i];
  }
}

}  // namespace

void add_listed_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  for (const Force& force : plan.forces) force.term->add(plan, force.values, time, x.data(), v.data(), f.data());
}

void compute_outer_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  set_gravity(plan, f);
  add_listed_forces(plan, time, x, v, f);
}

void compute_position_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  set_gravity(plan, f);
  add_spring_forces(plan, x.data(), nullptr, f.data());
  if (plan.pull) add_pull(plan, time, x, f);
  add_listed_forces(plan, time, x, v, f);
}

void compute_network_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  set_gravity(plan, f);
  add_spring_forces(plan, x.data(), plan.has_dashpots() ? v.data() : nullptr, f.data());
  if (plan.pull) add_pull(plan, time, x, f);
}

void compute_explicit_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  compute_network_forces(plan, time, x, v, f);
  add_listed_forces(plan, time, x, v, f);
}

void compute_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f) {
  compute_explicit_forces(plan, time, x, v, f);
  if (plan.drag != 0.0) add_drag(plan, v, f);
}

void divide_by_mass(const Plan& plan, Field& f) {
  for (int c = 0; c < plan.dimensions; ++c)
    multiply_each(f.data() + static_cast<std::size_t>(c) * plan.points, plan.inverse_mass.data(), plan.inverse_mass.size());
}

void plan_dashpot_decay(const Plan& plan, double duration, std::vector<double>& decay) {
  decay.resize(plan.damping.size());
  for (const SpringRun& run : plan.runs)
    for (Index e = 0; e < run.count; ++e) {
      const double inverse = plan.inverse_mass[run.first + e] + plan.inverse_mass[run.second + e];
      const Index s = run.begin + e;
      decay[s] = inverse == 0.0 ? 0.0 : -std::expm1(-plan.damping[s] * duration * inverse) / inverse;
    }
}

namespace {

template <int Dimensions>
void decay_dashpot(const Plan& plan, Index i, Index j, double decay, const double* x, double* v) {
  const std::size_t n = plan.points;
  double along[Dimensions], length_squared = 0.0, approach = 0.0;
  for (int c = 0; c < Dimensions; ++c) {
    along[c] = x[c * n + i] - x[c * n + j];
    length_squared += along[c] * along[c];
    approach += along[c] * (v[c * n + i] - v[c * n + j]);
  }
  if (length_squared == 0.0) return;
  const double impulse = decay * approach / length_squared;
  for (int c = 0; c < Dimensions; ++c) {
    v[c * n + i] -= plan.inverse_mass[i] * impulse * along[c];
    v[c * n + j] += plan.inverse_mass[j] * impulse * along[c];
  }
}

template <int Dimensions>
void decay_dashpots_in(const Plan& plan, const std::vector<double>& decay, Sweep sweep, const double* x, double* v) {
  if (sweep == Sweep::Forward) {
    for (const SpringRun& run : plan.runs)
      for (Index e = 0; e < run.count; ++e)
        decay_dashpot<Dimensions>(plan, run.first + e, run.second + e, decay[run.begin + e], x, v);
  } else {
    for (auto run = plan.runs.rbegin(); run != plan.runs.rend(); ++run)
      for (Index e = run->count - 1; e >= 0; --e)
        decay_dashpot<Dimensions>(plan, run->first + e, run->second + e, decay[run->begin + e], x, v);
  }
}

}  // namespace

void decay_dashpots(const Plan& plan, const std::vector<double>& decay, Sweep sweep, const Field& x, Field& v) {
  if (plan.dimensions == 2)
    decay_dashpots_in<2>(plan, decay, sweep, x.data(), v.data());
  else
    decay_dashpots_in<3>(plan, decay, sweep, x.data(), v.data());
}

}  // namespace hooke
