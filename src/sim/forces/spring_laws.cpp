#include "sim/forces/spring_laws.h"

#include <cmath>

#include "sim/model/portable_math.h"

namespace hooke {
namespace {

// From the second end to the first one, at x or, if v is given, at x + h v.
struct Axis {
  double u[3] = {};
  double length = 0.0;
};
Axis axis_of(const Plan& plan, const LawSpring& spring, const double* x, const double* v = nullptr, double h = 0.0) {
  Axis axis;
  double square = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t at = static_cast<std::size_t>(c) * plan.points;
    axis.u[c] = x[at + spring.first] - x[at + spring.second];
    if (v != nullptr) axis.u[c] += h * (v[at + spring.first] - v[at + spring.second]);
    square += axis.u[c] * axis.u[c];
  }
  axis.length = std::sqrt(square);
  for (double& component : axis.u) component = axis.length > 0.0 ? component / axis.length : 0.0;
  return axis;
}

// [m/s], at which the spring becomes longer.
double speed_along(const Plan& plan, const LawSpring& spring, const Axis& axis, const double* v) {
  double speed = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t at = static_cast<std::size_t>(c) * plan.points;
    speed += axis.u[c] * (v[at + spring.first] - v[at + spring.second]);
  }
  return speed;
}

// Pulls both ends together with weights of their own.
void pull(const Plan& plan, const LawSpring& spring, const Axis& axis, double of_first, double of_second, double* field) {
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t at = static_cast<std::size_t>(c) * plan.points;
    field[at + spring.first] -= of_first * axis.u[c];
    field[at + spring.second] += of_second * axis.u[c];
  }
}

// v_i -= w_i impulse u,  v_j += w_j impulse u
void apply_impulse(const Plan& plan, const LawSpring& spring, const Axis& axis, double impulse, Field& v) {
  pull(plan, spring, axis, plan.inverse_mass[spring.first] * impulse, plan.inverse_mass[spring.second] * impulse, v.data());
}

bool is_fixed(const Plan& plan, const LawSpring& spring) {
  return plan.inverse_mass[spring.first] == 0.0 && plan.inverse_mass[spring.second] == 0.0;
}

}  // namespace

void add_law_forces(const Plan& plan, double time, const double* x, const double* v, double* f) {
  for (const LawSpring& spring : plan.spring.laws.springs) {
    const Axis axis = axis_of(plan, spring, x);
    const PackedResponse response = response_of(spring, plan.spring.laws.clock, time, axis.length);
    double tension = response.of.tension;
    if (v != nullptr && response.damping > 0.0) tension += response.damping * speed_along(plan, spring, axis, v);
    pull(plan, spring, axis, tension, tension, f);
  }
}

double law_energy(const Plan& plan, double time, const Field& x) {
  double energy = 0.0;
  for (const LawSpring& spring : plan.spring.laws.springs)
    energy += response_of(spring, plan.spring.laws.clock, time, axis_of(plan, spring, x.data()).length).of.energy;
  return energy;
}

double law_dashpot_power(const Plan& plan, double time, const Field& x, const Field& v) {
  double power = 0.0;
  for (const LawSpring& spring : plan.spring.laws.springs) {
    if (spring.damping == 0.0) continue;
    const Axis axis = axis_of(plan, spring, x.data());
    const double speed = speed_along(plan, spring, axis, v.data());
    power += response_of(spring, plan.spring.laws.clock, time, axis.length).damping * speed * speed;
  }
  return power;
}

double muscle_power(const Plan& plan, double time, const Field& x) {
  const MuscleClock& clock = plan.spring.laws.clock;
  double power = 0.0;
  for (const LawSpring& spring : plan.spring.laws.springs) {
    const MovingLength rest = rest_length_at(spring.law, spring.rest_length, clock.at(time));
    if (rest.rate == 0.0) continue;
    const double extension = axis_of(plan, spring, x.data()).length - rest.length;
    power -= response_of(spring.law, spring.stiffness, extension).tension * rest.rate * clock.rate();
  }
  return power;
}

void sweep_law_dashpots(const Plan& plan, SweepDirection sweep, double duration, double time, const Field& x, Field& v) {
  const std::vector<LawSpring>& springs = plan.spring.laws.springs;
  for (std::size_t n = 0; n < springs.size(); ++n) {
    const LawSpring& spring = springs[sweep == SweepDirection::Forward ? n : springs.size() - 1 - n];
    if (spring.damping == 0.0 || is_fixed(plan, spring)) continue;
    const Axis axis = axis_of(plan, spring, x.data());
    const double damping = response_of(spring, plan.spring.laws.clock, time, axis.length).damping;
    const double inverse_mass = plan.inverse_mass[spring.first] + plan.inverse_mass[spring.second];
    const double loss = -portable::expm1(-damping * duration * inverse_mass) / inverse_mass;
    apply_impulse(plan, spring, axis, loss * speed_along(plan, spring, axis, v.data()), v);
  }
}

void project_laws(const Plan& plan, double h, double phi, double time, const Field& x, Field& v) {
  for (const LawSpring& spring : plan.spring.laws.springs) {
    if (is_fixed(plan, spring)) continue;
    const Axis axis = axis_of(plan, spring, x.data(), v.data(), h);
    const auto [of, damping] = response_of(spring, plan.spring.laws.clock, time, axis.length);
    const double inverse_mass = plan.inverse_mass[spring.first] + plan.inverse_mass[spring.second];
    const double impulse = phi * (of.tension + damping * speed_along(plan, spring, axis, v.data())) /
                           (1.0 + phi * (h * of.stiffness + damping) * inverse_mass);
    apply_impulse(plan, spring, axis, impulse, v);
  }
}

}  // namespace hooke
