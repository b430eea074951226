#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/constants.h"
#include "sim/contact/contact.h"
#include "sim/contact/gap.h"

namespace hooke {
namespace {

struct End {
  Vec3 x, v;
};

// A path that leads behind a wall, with the velocity of the rebound from where it meets it.
End rebound(const Collider& wall, double radius, double adhesion, double drag, const Parabola& path, double h) {
  const auto& plane = std::get<Plane>(wall.shape);
  double t = first_impact(wall, radius, path, h).value_or(h);
  // pressed from rest: an impact at the end
  if (glm::dot(plane.normal, path.velocity(t)) >= 0.0) t = h;
  const Vec3 v = path.velocity(t);
  Vec3 crossing = path.position(t);
  // not behind the plane by the error of the step, where it would be free
  crossing -= gap_to(wall, radius, crossing).distance * plane.normal;
  const double approach = -glm::dot(plane.normal, v), left = h - t;
  if (approach <= 0.0) return {crossing, v};
  const double leaving = wall.restitution * approach - adhesion;
  if (adhesion > 0.0 && leaving < 0.0) return {crossing, Vec3(0.0)};
  const Vec3 after = leaving * plane.normal + wall.restitution * (v + approach * plane.normal);
  const Vec3 a = path.a + change_of_drag(drag, left, after - v);
  End end{crossing + left * (after + 0.5 * left * a), after + left * a};
  // what presses again within the substep rests
  const double depth = -gap_to(wall, radius, end.x).distance;
  if (depth > 0.0) end = {end.x + depth * plane.normal, end.v - std::min(0.0, glm::dot(plane.normal, end.v)) * plane.normal};
  return end;
}

// Returns whether the end has changed. `a`: [m/s^2], the mean acceleration.
bool follow(const Plan& plan, const Vec3& x0, const Vec3& v0, const Vec3& a, double radius, double adhesion, double h, End& end) {
  bool is_changed = false;
  for (const Collider& wall : plan.one_way) {
    const double start = gap_to(wall, radius, x0).distance, speed = glm::dot(std::get<Plane>(wall.shape).normal, end.v);
    if (v0 == Vec3(0.0) && std::abs(start) < contact::held_distance && std::abs(speed) < h * adhesion) {
      end = {x0, Vec3(0.0)};
      return true;
    }
    if (start < -contact_tolerance(x0) || !(gap_to(wall, radius, end.x).distance < 0.0)) continue;
    end = rebound(wall, radius, adhesion, plan.drag, {end.x - h * (end.v - 0.5 * h * a), end.v - h * a, a}, h);
    is_changed = true;
  }
  return is_changed;
}

}  // namespace

bool rebound_from_walls(const Plan& plan, ContactWorkspace& before, double h, Motion& motion, double& work) {
  bool any = false;
  for (Index i = 0; i < plan.points && !plan.one_way.empty(); ++i) {
    if (plan.inverse_mass_in_contact()[i] == 0.0) continue;
    const Vec3 x0 = vector_at(plan, before.x, i), v0 = vector_at(plan, before.v, i), x1 = vector_at(plan, motion.x, i),
               v1 = vector_at(plan, motion.v, i);
    End end{x1, v1};
    const Vec3 a = (v1 - v0) / h;
    if (!follow(plan, x0, v0, a, plan.radius[i], plan.force_data.sticky.strength * plan.inverse_mass[i], h, end)) continue;
    any = true;
    // of contact, in addition to that of the forces
    work += plan.mass[i] * (0.5 * (glm::dot(end.v, end.v) - glm::dot(v1, v1)) - glm::dot(a, end.x - x1));
    set_vector(plan, motion.x, i, end.x);
    set_vector(plan, motion.v, i, end.v);
  }
  if (any) before.first_touch = before.first_impact = 0.0;
  return any;
}

}  // namespace hooke
