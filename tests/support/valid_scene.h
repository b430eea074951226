// Whether the scene of a status can be computed and saved.
#pragma once

#include <cmath>

#include "lab/status.h"

namespace hooke {

inline bool is_number(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

inline bool is_valid(const Status& status) {
  const Snapshot& snapshot = *status.snapshot;
  const System& system = *snapshot.system;
  const State& state = snapshot.state;
  const auto points = static_cast<std::size_t>(system.point_count());
  if (state.position.size() != points || state.velocity.size() != points) return false;
  for (std::size_t i = 0; i < points; ++i) {
    const Point& point = system.points()[i];
    if (system.index_of(point.id) != static_cast<Index>(i) || !is_number(state.position[i]) || !is_number(state.velocity[i])) return false;
    if (!(point.mass > 0.0) || !std::isfinite(point.mass) || !(point.radius >= 0.0) || !std::isfinite(point.radius)) return false;
  }
  for (const Spring& spring : system.springs()) {
    if (system.index_of(spring.first) == no_index || system.index_of(spring.second) == no_index || spring.first == spring.second)
      return false;
    for (const double value : {spring.stiffness, spring.damping, spring.rest_length})
      if (!(value >= 0.0) || !std::isfinite(value)) return false;
    if (!(spring.break_strain > 0.0)) return false;
  }
  for (const Face& face : system.faces)
    for (const PointId id : face.points)
      if (system.index_of(id) == no_index) return false;
  return is_number(system.gravity) && std::isfinite(system.drag) && snapshot.settings.substeps > 0 && snapshot.settings.frame_rate > 0.0;
}

}  // namespace hooke
