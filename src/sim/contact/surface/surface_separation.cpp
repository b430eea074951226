// The part of SurfaceStep that separates what is closer than its thickness.
#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/contact/surface/surface_step.h"

namespace hooke {
namespace {

// The part of what features are closer than their thickness by which they separate in a substep, and the time for most of it [s].
constexpr double max_separation = 0.2, separation_time = 0.02;

}  // namespace

// Displacements, without velocities, that separate what is closer than its thickness. Returns whether there are any.
bool SurfaceStep::separate(const Plan& plan, const Field& v0, double h, const Motion& motion) {
  path_ = u_;
  bool any = false;
  const double part = std::min(max_separation, h / separation_time);
  for (SurfaceContact& contact : contacts_.surface)
    if (contact.gap < 0.0) {
      contact.target = -part * contact.gap / h;
      any = true;
    }
  if (!any) return false;
  for (SurfaceContact& contact : contacts_.surface) contact.separating = -contact.impulse;
  any = contacts_.separate(inverse_mass_, path_);
  for (SurfaceContact& contact : contacts_.surface) contact.separating += contact.impulse;
  if (any) limit_separation(plan, v0, h, motion);
  return any;
}

// What touches works against springs and other forces with no more energy than contact removes from it in this substep, and than lifts its
// weight by the largest displacement: weight would press a heap into itself without end, and springs transmit it.
void SurfaceStep::limit_separation(const Plan& plan, const Field& v0, double h, const Motion& motion) {
  // the forces change along the displacement
  constexpr double margin = 1.25, rounding = 1e-12;
  const std::size_t n = x_.size();
  groups_.reset(n);
  for (const SurfaceContact& contact : contacts_.surface) {
    if (contact.impulse == 0.0) continue;
    Index first = no_index;
    for (const Index k : contact.points) {
      if (inverse_mass_[k] == 0.0) continue;
      if (first != no_index) groups_.join(first, k);
      first = k;
    }
  }

  removed_.assign(n, 0.0);
  weight_.assign(n, 0.0);
  lift_.assign(n, 0.0);
  needed_.assign(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    if (inverse_mass_[k] == 0.0 || path_[k] == free_u_[k]) continue;
    const Index i = plan.surface.points[k], group = groups_.root(static_cast<Index>(k));
    const Vec3 v1 = point_in(plan, motion.v, i), change = u_[k] - free_u_[k], separation = h * (path_[k] - u_[k]);
    const Vec3 acceleration = (free_velocity_[k] - point_in(plan, v0, i)) / h;
    weight_[group] += plan.mass[i] * glm::length(plan.gravity);
    lift_[group] = std::max(lift_[group], glm::length(separation));
    removed_[group] -= plan.mass[i] * (glm::dot(v1 + 0.5 * change, change) - h * glm::dot(acceleration, change));
    needed_[group] -=
        plan.mass[i] * (glm::dot(acceleration - plan.gravity, separation) + rounding * glm::length(acceleration) * glm::length(separation));
  }
  // the part of the separation that there is energy for
  for (std::size_t k = 0; k < n; ++k) {
    if (groups_.root(static_cast<Index>(k)) != static_cast<Index>(k)) continue;
    const double removed = std::max(0.0, removed_[k]) + weight_[k] * lift_[k], needed = margin * needed_[k];
    needed_[k] = needed > removed ? removed / needed : 1.0;
  }
  for (std::size_t k = 0; k < n; ++k) path_[k] = u_[k] + needed_[groups_.root(static_cast<Index>(k))] * (path_[k] - u_[k]);
  for (SurfaceContact& contact : contacts_.surface) {
    const auto* free = std::ranges::find_if(contact.points, [&](Index k) { return inverse_mass_[k] != 0.0; });
    const double left_out = (1.0 - needed_[groups_.root(*free)]) * contact.separating;
    contact.separating -= left_out;
    contact.impulse -= left_out;
  }
}

}  // namespace hooke
