#include "sim/step/automatic/rates.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace hooke {

double rates_of(const Plan& plan) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](double value) { hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3; };
  const auto add_vector = [&](const Vec3& value) { add(value.x), add(value.y), add(value.z); };
  const Spectrum& s = plan.spectrum;
  for (const double value : {s.omega, s.dashpot_rate, s.force_omega, s.force_rate, s.drag_rate}) add(value);
  for (const auto* values : {&plan.mass, &plan.inverse_mass, &plan.radius, &plan.spring.stiffness, &plan.spring.rest_length,
                             &plan.spring.damping, &plan.spring.max_length, &plan.spring.break_length})
    for (const double value : *values) add(value);
  for (const Force& force : plan.forces)
    for (const double value : force.values) add(value);
  for (const Collider& collider : plan.colliders) add(collider.restitution), add(collider.friction);
  if (std::isfinite(plan.collider_paths.resolving_step)) add(plan.collider_paths.resolving_step);
  if (plan.pairs.on) add(plan.pairs.thickness), add(plan.pairs.restitution), add(plan.pairs.friction);
  if (plan.surface.on) add(plan.surface.max_thickness), add(plan.surface.friction), add(plan.surface.restitution);
  add(plan.hand.held ? 1.0 : plan.collider_paths.grabbed ? 2.0 : 0.0);
  if (plan.hand.pull) add(plan.hand.pull->stiffness);
  add_vector(plan.acceleration);
  // the high bits depend on all others
  hash ^= hash >> 32;
  hash *= 0xd6e8feb86659fd93;
  return static_cast<double>(hash >> 11);
}

}  // namespace hooke
