// a = s / r^p towards a center at distance r: p = 2 is an inverse-square law, p = -1 a spring. Inside the core, r < r0,
//   a = s / r0^p (alpha u + beta u^3),  u = r / r0,  alpha = (p + 3) / 2,  beta = -(p + 1) / 2,
// which continues value and slope at r0 and is smooth at the center. For p = -1 and p = -3 both laws are the same. A squared core, that of
// XSpringies, has a = s / r0^p u^2.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/force_tangent.h"
#include "sim/forces/passage.h"
#include "sim/forces/terms/power_law.h"
#include "sim/forces/terms/rows.h"
#include "sim/model/portable_math.h"
#include "sim/plan/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {
    {"x", "Center x", "m", -100.0, 100.0, 0.0},
    {"y", "Center y", "m", -100.0, 100.0, 0.0},
    {"z", "Center z", "m", -100.0, 100.0, 0.0},
    {"strength", "Strength at 1 m", "m/s^2", -1000.0, 1000.0, 1.0},
    {"power", "Exponent", "", -3.0, 4.0, 2.0},
    {"core", "Core radius", "m", 1e-6, 10.0, 0.01},
    {"squared_core", "Squared core", "", 0.0, 1.0, 0.0, true},
};

// The law in units of its strength: acceleration a(r), its slope a'(r), and the transverse stiffness a(r) / r.
struct Law {
  double power, core;
  bool is_squared;

  // also the upper bound on the slope in the core, relative to a / r at its border
  double alpha() const { return is_squared ? 2.0 : 0.5 * (power + 3.0); }
  double beta() const { return -0.5 * (power + 1.0); }
  double over_distance(double r) const {
    if (r >= core) return portable::pow(r, -power - 1.0);
    const double u = r / core;
    return portable::pow(core, -power - 1.0) * (is_squared ? u : alpha() + beta() * u * u);
  }
  double slope(double r) const {
    if (r >= core) return -power * portable::pow(r, -power - 1.0);
    const double u = r / core;
    return portable::pow(core, -power - 1.0) * (is_squared ? 2.0 * u : alpha() + 3.0 * beta() * u * u);
  }
  // the integral of a to r, from infinity if it is finite, else from the core radius
  double potential(double r) const {
    if (r >= core) return power_law_potential(power, core, r);
    const double u = r / core;
    const double smooth = 0.5 * alpha() * (u * u - 1.0) + 0.25 * beta() * (u * u * u * u - 1.0);
    return power_law_potential(power, core, core) + portable::pow(core, 1.0 - power) * (is_squared ? (u * u * u - 1.0) / 3.0 : smooth);
  }
};

Law law_of(const ForceValues& values) { return {values[4], values[5], values[6] != 0.0}; }

// In a flat scene at z = 0, as its points are.
Vec3 center_in(int dimensions, const ForceValues& values) { return {values[0], values[1], dimensions == 3 ? values[2] : 0.0}; }

// Position of point i relative to the center.
Vec3 offset_from(const Plan& plan, const ForceValues& values, const double* x, Index i) {
  const Index center = plan.force_data.center;
  return vector_at(plan, x, i) - (center == no_index ? center_in(plan.dimensions, values) : vector_at(plan, x, center));
}

void add(const Plan& plan, const ForceValues& values, double, const double* x, const double*, double* f) {
  const Law law = law_of(values);
  for (Index i = 0; i < plan.points; ++i) {
    const Vec3 offset = offset_from(plan, values, x, i);
    add_vector(plan, f, i, -plan.mass[i] * values[3] * law.over_distance(glm::length(offset)) * offset);
  }
}

// |a'| and |a / r| decrease with r outside the core if p >= -1, and otherwise increase without limit; inside they are between their values
// at r = 0 and r = r0.
ForceBound bound(const System&, const Plan&, const ForceValues& values, double) {
  const Law law = law_of(values);
  const double strength = std::abs(values[3]), at_core = strength * portable::pow(law.core, -law.power - 1.0);
  ForceBound bound{.stiffness = at_core * std::max({law.alpha(), std::abs(law.power), 1.0})};
  // the highest value of alpha u + beta u^3 on [0, 1] is below alpha, or 1
  const double max_acceleration = at_core * law.core * std::max(law.alpha(), 1.0);
  if (law.power >= 0.0)
    bound.acceleration = max_acceleration;
  else if (values[3] < 0.0)
    bound.acceleration = ForceBound::none;
  // an attraction that falls with the distance is negative along it, a repulsion across it and in the core
  if (values[3] < 0.0)
    bound.omitted_stiffness = bound.stiffness;
  else if (law.power > 0.0)
    bound.omitted_stiffness = at_core * law.power;
  if (law.power < -1.0 && strength > 0.0) {
    bound.stiffness = ForceBound::none;
    bound.estimated_stiffness = strength * std::abs(law.power);
    if (values[3] < 0.0) bound.omitted_stiffness = bound.estimated_stiffness;
  }
  return bound;
}

void add_tangent(const Plan& plan, const ForceValues& values, double, const double* x, const double*, ForceTangent& tangent) {
  const Law law = law_of(values);
  for (Index i = 0; i < plan.points; ++i) {
    const Vec3 offset = offset_from(plan, values, x, i);
    const double distance = glm::length(offset), strength = plan.mass[i] * values[3];
    const Vec3 u = distance > 0.0 ? offset / distance : Vec3(1.0, 0.0, 0.0);
    tangent.add_stiffness(i, u, strength * law.slope(distance), strength * law.over_distance(distance));
  }
}

double potential_at(const System& system, const ForceValues& values, const Vec3& place) {
  return values[3] * law_of(values).potential(glm::distance(place, center_in(system.dimensions, values)));
}

double potential(const Plan& plan, const ForceValues& values, double, const double* x) {
  const Law law = law_of(values);
  double energy = 0.0;
  for (Index i = 0; i < plan.points; ++i)
    if (plan.inverse_mass[i] != 0.0) energy += plan.mass[i] * values[3] * law.potential(glm::length(offset_from(plan, values, x, i)));
  return energy;
}

// [W], on a center that moves.
double power(const Plan& plan, const ForceValues& values, double, const double* x, const double* v) {
  if (plan.force_data.center == no_index) return 0.0;
  const Law law = law_of(values);
  Vec3 force(0.0);
  for (Index i = 0; i < plan.points; ++i) {
    const Vec3 offset = offset_from(plan, values, x, i);
    if (plan.inverse_mass[i] != 0.0) force -= plan.mass[i] * values[3] * law.over_distance(glm::length(offset)) * offset;
  }
  return glm::dot(force, vector_at(plan, v, plan.force_data.center));
}

// Through the core, or past the center at the distance that the angular momentum allows. Up to p = -1 the acceleration increases with the
// distance, in the core too, and nothing is steeper there.
Passage passage(const ForceValues& values, const PassingPoint& point) {
  const Law law = law_of(values);
  if (law.power <= -1.0) return {};
  // a free center may be anywhere
  const Index at = point.system.center_point ? point.system.index_of(*point.system.center_point) : no_index;
  if (at != no_index && !point.system.points()[at].nailed) return {};
  const Vec3 center = center_in(point.system.dimensions, values), offset = point.position - center;
  const double r = glm::length(offset), strength = values[3];
  const double far = 0.5 * glm::dot(point.velocity, point.velocity) + point.elastic + point.gravity * r;
  const double kinetic = far + point.supplied_by_others(center);
  const double momentum = point.is_alone ? glm::length(glm::cross(offset, point.velocity)) : 0.0;
  const double potential = law.potential(r);
  const auto speed_at = [&](double distance) {
    return std::sqrt(std::max(0.0, 2.0 * (kinetic + strength * (potential - law.potential(distance)))));
  };

  // it takes longer than at the speed that it reaches at half the distance
  const double near = std::max(0.5 * r, law.core);
  if (r > near && (r - near) > point.within * std::max(speed_at(r), speed_at(near))) return {};

  // the closest distance, or a little more: r v(r) >= L
  double closest = law.core;
  const auto is_reached = [&](double distance) { return speed_at(distance) > 0.0 && distance * speed_at(distance) >= momentum; };
  if (r > law.core && !is_reached(law.core)) {
    double low = law.core;
    closest = r;
    for (int i = 0; i < 20; ++i) {
      const double middle = std::sqrt(low * closest);
      (is_reached(middle) ? closest : low) = middle;
    }
  }
  const bool in_core = closest == law.core;
  return {.speed = std::max(speed_at(in_core ? 0.0 : closest), speed_at(r)),
          .length = closest,
          .acceleration = std::abs(strength) * portable::pow(closest, -law.power) * (in_core ? std::max(law.alpha(), 1.0) : 1.0),
          .energy = far + std::abs(strength) * law.over_distance(r) * r};
}

}  // namespace

constinit const ForceTerm center_force{
    .id = "center",
    .rank = 4,
    .label = "Central attraction",
    .description = "Attracts every point to a center, with an acceleration that falls with a power of the distance.",
    .numbers = numbers,
    .add = add,
    .bound = bound,
    .add_tangent = add_tangent,
    .potential = potential,
    .power = power,
    .cost = [](const Plan&, const ForceValues& values) { return cost_of_power_law(values[4], 1.0); },
    .potential_at = potential_at,
    .passage = passage,
};

}  // namespace hooke
