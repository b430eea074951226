#include "device/constants.h"
#include "device/gpu_device.h"
#include "sim/methods/rows.h"

namespace hooke {

std::string needs_processor(const Plan& plan, const Integrator& method) {
  if (&method != &symplectic_euler && &method != &velocity_verlet && &method != &velocity_verlet_explicit)
    return "the method " + std::string(method.id) + ": symplectic_euler, velocity_verlet and velocity_verlet_explicit run there";
  if (plan.pairs.on) return "contact of points with each other";
  if (plan.surface.on) return "contact of faces and springs";
  if (!plan.one_way.empty()) return "planes that act one way";
  if (plan.colliders.size() > max_device_colliders) return "more than " + std::to_string(max_device_colliders) + " colliders";
  if (!plan.spring.max_length.empty()) return "the strain limit";
  for (const Force& force : plan.forces)
    if (force.term->id != "wind") return "the force " + std::string(force.term->id);
  if (plan.forces.size() > 1) return "more than one wind";
  for (const LawSpring& spring : plan.spring.laws.springs) {
    if (spring.law.moves()) return "springs whose rest length moves";
    if (spring.law.force == SpringForce::Strut) return "struts";
    if (spring.law.force == SpringForce::Cubic) return "springs with a cubic force";
  }
  if (plan.points > max_device_points) return "more than " + std::to_string(max_device_points) + " points";
  if (plan.points == 0) return "a scene without points";
  return {};
}

}  // namespace hooke
