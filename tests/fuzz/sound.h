// What every scene must be that a reader lets through, whatever the bytes it was made from. Says what is wrong, and aborts.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "formats/scene_file.h"
#include "sim/integrator.h"
#include "sim/plan.h"

namespace hooke {

inline void require(bool claim, const char* words) {
  if (claim) return;
  std::fprintf(stderr, "not so: %s\n", words);
  std::abort();
}

inline void require_finite(const Vec3& v, const char* words) {
  require(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z), words);
}

inline void require_sound(const LoadedScene& loaded) {
  const System& system = loaded.scene.system;
  const State& state = loaded.scene.state;
  require(state.position.size() == system.points().size() && state.velocity.size() == system.points().size(), "every point has a place");
  for (const Vec3& x : state.position) require_finite(x, "places are numbers");
  for (const Vec3& v : state.velocity) require_finite(v, "velocities are numbers");
  for (const Point& point : system.points())
    require(point.mass > 0.0 && std::isfinite(point.mass) && point.radius >= 0.0, "masses are above 0");
  for (const Spring& spring : system.springs()) {
    require(system.index_of(spring.first) != no_index && system.index_of(spring.second) != no_index, "springs join points");
    require(spring.first != spring.second, "springs join two points");
    require(spring.stiffness >= 0.0 && std::isfinite(spring.stiffness), "stiffness is at least 0");
    require(spring.damping >= 0.0 && std::isfinite(spring.damping), "damping is at least 0");
    require(spring.rest_length >= 0.0 && std::isfinite(spring.rest_length), "rest lengths are at least 0");
  }
  for (const Face& face : system.faces)
    for (const PointId id : face.points) require(system.index_of(id) != no_index, "faces are of points");
  require_finite(system.gravity, "gravity is a number");
  require(loaded.scene.settings.substeps >= 1 && loaded.scene.settings.frame_rate > 0.0, "there are steps");
  for (const std::string& warning : loaded.warnings) require(warning.find('\n') == std::string::npos, "a warning is one line");
}

// Of a scene whose step was chosen for it, unless it says that nothing holds.
inline void require_stable(const LoadedScene& loaded) {
  for (const std::string& warning : loaded.warnings)
    if (warning.find("no step holds") != std::string::npos) return;
  const Settings& settings = loaded.scene.settings;
  require(settings.substep() <= largest_stable_step(*settings.integrator, bound_spectrum(loaded.scene.system)), "the step holds");
}

}  // namespace hooke
