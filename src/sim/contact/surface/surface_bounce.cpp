// The part of SurfaceStep that lets what touches rebound.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/surface/surface_step.h"

namespace hooke {
namespace {

// What approaches more slowly than this multiple of what the accelerations supply in a substep rests.
constexpr double rest_speed = 2.0;

}  // namespace

// How fast features approach each other where their path first touches, and the relative velocity after the impact. The velocities of the
// method that belong to positions are ahead of it by its lag. Those whose further bounces, 2 e v / (a (1 - e)) long, all end within a
// substep rest, too.
void SurfaceStep::note_impacts(const Plan& plan, const Field& v0, double h, const Motion& motion) {
  const double e = plan.surface.restitution;
  if (e == 0.0) return;
  const double slow = std::max(rest_speed, 0.5 * (1.0 - e) / e);
  for (SurfaceContact& contact : contacts_.surface) {
    double path = 0.0, before = 0.0, after = 0.0, supplied = 0.0;  // [m/s], along the normal
    for (int c = 0; c < 4; ++c) {
      const Index k = contact.points[c], i = plan.surface.points[k];
      const Vec3 weighted_normal = contact.weight[c] * contact.normal, start = point_in(plan, v0, i);
      path += glm::dot(weighted_normal, free_u_[k]);
      before += glm::dot(weighted_normal, start);
      after += glm::dot(weighted_normal, point_in(plan, motion.v, i));
      supplied += glm::dot(weighted_normal, free_velocity_[k] - start);
    }
    const double part = path < 0.0 ? std::clamp(-contact.gap / (h * path), 0.0, 1.0) : 1.0;
    contact.ahead = velocity_lag_ * supplied;
    contact.approach = -(before + part * (after - before) + contact.ahead);
    if (contact.approach > slow * std::abs(supplied)) contact.rebound = e * contact.approach - contact.ahead;
  }
}

// After all else, at the end of the substep: impulses bring what has had an impact to its velocity after it, and return at most e^2 of the
// energy that those before have taken along the normals. Where many act on the same points, they may exceed that: then all of them
// are smaller.
void SurfaceStep::rebound(const Plan& plan) {
  double limit = 0.0;  // [J]
  for (const SurfaceContact& contact : contacts_.surface)
    if (contact.rebound > 0.0) limit += 0.5 * (contact.pressing + contact.impulse.normal) * (contact.approach - contact.ahead);
  if (!(limit > 0.0)) return;
  limit *= plan.surface.restitution * plan.surface.restitution;
  at_rest_ = velocity_;
  for (SurfaceContact& contact : contacts_.surface) {
    contact.before_rebound = contact.impulse.normal;
    contact.target = std::max(0.0, contact.rebound);
  }
  contacts_.settle(inverse_mass_, plan.surface.friction, velocity_);

  // the work of a part s of the impulses is s (linear + s quadratic)
  double linear = 0.0, quadratic = 0.0;  // [J]
  for (SurfaceContact& contact : contacts_.surface) {
    const double impulse = contact.impulse.normal - contact.before_rebound;
    const double start = glm::dot(contact.normal, weighted(at_rest_, contact.points, contact.weight));
    linear += impulse * (start + contact.ahead);
    quadratic += 0.5 * impulse * (glm::dot(contact.normal, weighted(velocity_, contact.points, contact.weight)) - start);
    contact.target = 0.0;
  }
  if (linear + quadratic <= limit) return;
  const double part = 2.0 * limit / (linear + std::sqrt(linear * linear + 4.0 * quadratic * limit));
  for (std::size_t k = 0; k < velocity_.size(); ++k) velocity_[k] = at_rest_[k] + part * (velocity_[k] - at_rest_[k]);
}

}  // namespace hooke
