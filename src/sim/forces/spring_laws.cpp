#include "sim/forces/spring_laws.h"

#include <glm/geometric.hpp>

#include "sim/model/portable_math.h"

namespace hooke {
namespace {

// From the second end to the first one, at x or, if v is given, at x + h v.
struct Axis {
  Vec3 u{0.0};
  double length = 0.0;
};
Axis axis_of(const Plan& plan, const LawSpring& spring, const double* x, const double* v = nullptr, double h = 0.0) {
  const auto between = [&](const double* field) { return vector_at(plan, field, spring.first) - vector_at(plan, field, spring.second); };
  const Vec3 along = v != nullptr ? between(x) + h * between(v) : between(x);
  const double length = glm::length(along);
  return {length > 0.0 ? along / length : Vec3(0.0), length};
}

// [m/s], at which the spring becomes longer.
double speed_along(const Plan& plan, const LawSpring& spring, const Axis& axis, const double* v) {
  return glm::dot(axis.u, vector_at(plan, v, spring.first) - vector_at(plan, v, spring.second));
}

// v_i -= w_i impulse u,  v_j += w_j impulse u
void apply_impulse(const Plan& plan, const LawSpring& spring, const Axis& axis, double impulse, Field& v) {
  add_vector(plan, v, spring.first, free_part(plan, spring.first, -plan.inverse_mass[spring.first] * impulse * axis.u));
  add_vector(plan, v, spring.second, free_part(plan, spring.second, plan.inverse_mass[spring.second] * impulse * axis.u));
}

// [1/kg], of both ends along the axis: w1 + w2, less of rollers; 0: neither moves along it.
double inverse_mass_along(const Plan& plan, const LawSpring& spring, const Axis& axis) {
  const auto part = [&](Index i) { return plan.inverse_mass[i] * glm::dot(axis.u, free_part(plan, i, axis.u)); };
  if (!plan.force_data.rollers.empty()) return part(spring.first) + part(spring.second);
  return plan.inverse_mass[spring.first] + plan.inverse_mass[spring.second];
}

}  // namespace

void add_law_forces(const Plan& plan, double time, const double* x, const double* v, double* f) {
  for (const LawSpring& spring : plan.spring.laws.springs) {
    const Axis axis = axis_of(plan, spring, x);
    const PackedResponse response = response_of(spring, plan.spring.laws.clock, time, axis.length);
    double tension = response.of.tension;
    if (v != nullptr && response.damping > 0.0) tension += response.damping * speed_along(plan, spring, axis, v);
    add_vector(plan, f, spring.first, -tension * axis.u);
    add_vector(plan, f, spring.second, tension * axis.u);
  }
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
    const Axis axis = axis_of(plan, spring, x.data());
    const double inverse_mass = inverse_mass_along(plan, spring, axis);
    if (spring.damping == 0.0 || inverse_mass == 0.0) continue;
    const double damping = response_of(spring, plan.spring.laws.clock, time, axis.length).damping;
    const double loss = -portable::expm1(-damping * duration * inverse_mass) / inverse_mass;
    apply_impulse(plan, spring, axis, loss * speed_along(plan, spring, axis, v.data()), v);
  }
}

void project_laws(const Plan& plan, double h, double phi, double time, const Field& x, Field& v) {
  for (const LawSpring& spring : plan.spring.laws.springs) {
    const Axis axis = axis_of(plan, spring, x.data(), v.data(), h);
    const double inverse_mass = inverse_mass_along(plan, spring, axis);
    if (inverse_mass == 0.0) continue;
    const auto [of, damping] = response_of(spring, plan.spring.laws.clock, time, axis.length);
    const double impulse = phi * (of.tension + damping * speed_along(plan, spring, axis, v.data())) /
                           (1.0 + phi * (h * of.stiffness + damping) * inverse_mass);
    apply_impulse(plan, spring, axis, impulse, v);
  }
}

}  // namespace hooke
