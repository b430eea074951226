#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/constants.h"
#include "sim/contact/contact.h"
#include "sim/contact/gap.h"

namespace hooke {
namespace {

// A point at the end of a substep, with its mean acceleration in it.
struct Path {
  Vec3 x, v, a;
};

// The path after the time `left` from the end back, at which it crosses the plane, continued with the velocity of the rebound.
void rebound(Path& path, const Vec3& normal, double height, double left, double restitution, double adhesion) {
  Vec3 v = path.v - left * path.a;
  if (glm::dot(normal, v) >= 0.0) {
    // pressed from rest: an impact at the end
    left = 0.0;
    v = path.v;
  }
  Vec3 crossing = path.x - left * path.v + 0.5 * left * left * path.a;
  // not behind the plane by the error of the step, where it would be free
  crossing += (height - glm::dot(normal, crossing)) * normal;
  const double approach = -glm::dot(normal, v);
  if (approach <= 0.0) {
    path.x = crossing;
    return;
  }
  const double leaving = restitution * approach - adhesion;
  if (adhesion > 0.0 && leaving < 0.0) {
    path.x = crossing;
    path.v = Vec3(0.0);
    return;
  }
  const Vec3 after = leaving * normal + restitution * (v + approach * normal);
  path.x = crossing + left * (after + 0.5 * left * path.a);
  path.v = after + left * path.a;
  // what presses again within the substep rests
  const double depth = height - glm::dot(normal, path.x);
  if (depth <= 0.0) return;
  path.x += depth * normal;
  path.v -= std::min(0.0, glm::dot(normal, path.v)) * normal;
}

// [s], from the end of the substep back to where the distance g0 + b s + a s^2 / 2 becomes 0; g1 < 0: at its end.
double time_after_crossing(double g0, double g1, double a, double h) {
  const double b = (g1 - g0) / h - 0.5 * a * h, root = std::sqrt(std::max(0.0, b * b - 2.0 * a * g0));
  const double time = g0 <= 0.0 ? 0.0 : 2.0 * g0 / (root - b);
  return std::isfinite(time) ? std::clamp(h - time, 0.0, h) : 0.0;
}

// Returns whether the path has changed.
bool follow(const Plan& plan, const Vec3& x0, const Vec3& v0, double radius, double adhesion, double h, Path& path) {
  bool is_changed = false;
  for (const Collider& wall : plan.one_way) {
    const auto& plane = std::get<Plane>(wall.shape);
    const double height = glm::dot(plane.normal, plane.point) + radius, g0 = glm::dot(plane.normal, x0) - height;
    if (v0 == Vec3(0.0) && std::abs(g0) < contact::held_distance && std::abs(glm::dot(plane.normal, path.v)) < h * adhesion) {
      path.x = x0;
      path.v = Vec3(0.0);
      return true;
    }
    const double g1 = glm::dot(plane.normal, path.x) - height;
    if (g0 < -contact_tolerance(x0) || !(g1 < 0.0)) continue;
    const double left = time_after_crossing(g0, g1, glm::dot(plane.normal, path.a), h);
    rebound(path, plane.normal, height, left, wall.restitution, adhesion);
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
    Path path{x1, v1, (v1 - v0) / h};
    const double adhesion = plan.force_data.sticky.strength * plan.inverse_mass[i];
    if (!follow(plan, x0, v0, plan.radius[i], adhesion, h, path)) continue;
    any = true;
    // of contact, in addition to that of the forces
    work += plan.mass[i] * (0.5 * (glm::dot(path.v, path.v) - glm::dot(v1, v1)) - glm::dot(path.a, path.x - x1));
    set_vector(plan, motion.x, i, path.x);
    set_vector(plan, motion.v, i, path.v);
  }
  if (any) before.first_touch = before.first_impact = 0.0;
  return any;
}

}  // namespace hooke
