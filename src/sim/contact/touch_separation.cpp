// The part of TouchSimulation that separates what overlaps.
#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/contact/touch_simulation.h"

namespace hooke {

// Displacements that slowly separate overlaps larger than those that deferred impacts cause: by a fifth of the excess, and at most by a
// tenth of the distance that the accelerations cover in the substep. Velocities do not change: nothing flies apart.
void TouchSimulation::find_separation(double tolerance) {
  separation_.displacement.assign(paths.size(), Vec3(0.0));
  bool any = false;
  for (const std::size_t k : active_) {
    Touch& touch = touches[k];
    const double reach = h_ * velocity_change(touch), depth = std::max(0.0, -touch.gap - 4.0 * reach);
    touch.min_velocity = std::min(0.2 * depth, 0.1 * reach);
    touch.impulse = {};
    touch.surface = Vec3(0.0);
    any = any || touch.min_velocity > 0.0;
  }
  separation_.any = any;
  if (!any) return;
  settle(touches, active_, h_ * tolerance, separation_.displacement);
  change_pushed();
}

// Points that rest on each other work against springs and other forces with no more energy than contact removes from them in this substep.
// Gravity may be worked against: what it presses into each other over many substeps would sink without end.
void TouchSimulation::limit_separation() {
  // the forces change along the displacement
  constexpr double margin = 1.25, rounding = 1e-12;
  const std::size_t n = paths.size();
  separation_.groups.reset(n);
  for (const std::size_t k : active_) {
    const Touch& touch = touches[k];
    if (paths[touch.first].inverse_mass == 0.0 || paths[touch.second].inverse_mass == 0.0) continue;
    separation_.groups.join(static_cast<Index>(touch.first), static_cast<Index>(touch.second));
  }

  separation_.removed.assign(n, 0.0);
  separation_.needed.assign(n, 0.0);
  for (std::size_t p = 0; p < n; ++p) {
    const PointPath& path = paths[p];
    if (path.inverse_mass == 0.0) continue;
    const Index group = separation_.groups.root(static_cast<Index>(p));
    const Vec3 force = (path.free_acceleration - gravity_) / path.inverse_mass;
    separation_.removed[group] -= path.contact_work();
    const double round_off = rounding * glm::length(path.free_acceleration) / path.inverse_mass * glm::length(separation_.displacement[p]);
    separation_.needed[group] -= glm::dot(force, separation_.displacement[p]) + round_off;
  }
  for (std::size_t p = 0; p < n; ++p) {
    const Index group = separation_.groups.root(static_cast<Index>(p));
    const double removed = std::max(0.0, separation_.removed[group]), needed = margin * separation_.needed[group];
    if (needed > removed) separation_.displacement[p] *= removed / needed;
  }
}

}  // namespace hooke
