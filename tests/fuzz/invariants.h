// Invariants of every scene that a reader accepts, whatever bytes it was made from. Prints the violated invariant and aborts.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "formats/scene_file.h"
#include "sim/methods/integrator.h"
#include "sim/plan/plan.h"

namespace hooke {

inline void require(bool claim, const char* words) {
  if (claim) return;
  std::fprintf(stderr, "violated: %s\n", words);
  std::abort();
}

inline void require_finite(const Vec3& v, const char* words) {
  require(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z), words);
}

inline void require_valid(const LoadedScene& loaded) {
  const System& system = loaded.scene.system;
  const State& state = loaded.scene.state;
  require(state.position.size() == system.points().size() && state.velocity.size() == system.points().size(), "every point has a position");
  for (const Vec3& x : state.position) require_finite(x, "positions are finite");
  for (const Vec3& v : state.velocity) require_finite(v, "velocities are finite");
  for (const Point& point : system.points())
    require(point.mass > 0.0 && std::isfinite(point.mass) && point.radius >= 0.0, "masses are more than 0");
  for (const Spring& spring : system.springs()) {
    require(system.index_of(spring.first) != no_index && system.index_of(spring.second) != no_index, "springs connect points of the scene");
    require(spring.first != spring.second, "springs connect two different points");
    require(spring.stiffness >= 0.0 && std::isfinite(spring.stiffness), "stiffness is at least 0");
    require(spring.damping >= 0.0 && std::isfinite(spring.damping), "damping is at least 0");
    require(spring.rest_length >= 0.0 && std::isfinite(spring.rest_length), "rest lengths are at least 0");
  }
  for (const Face& face : system.faces)
    for (const PointId id : face.points) require(system.index_of(id) != no_index, "faces refer to points of the scene");
  require_finite(system.gravity, "gravity is finite");
  require(loaded.scene.settings.substeps >= 1 && loaded.scene.settings.frame_rate > 0.0, "steps have a positive length");
  for (const std::string& warning : loaded.warnings) require(warning.find('\n') == std::string::npos, "a warning is one line");
}

// For a scene whose step was chosen by the reader, unless a warning says that no step is stable.
inline void require_stable(const LoadedScene& loaded) {
  for (const std::string& warning : loaded.warnings)
    if (warning.find("no step is stable") != std::string::npos) return;
  const Settings& settings = loaded.scene.settings;
  require(settings.substep() <= largest_stable_step(*settings.integrator, bound_spectrum(loaded.scene.system)), "the step is stable");
}

}  // namespace hooke
