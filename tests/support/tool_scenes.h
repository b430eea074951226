// Scenes for tests of tools.
#pragma once

#include <glm/geometric.hpp>

#include "support/tool_fixture.h"

namespace hooke {

inline const Vec3 a(-0.5, 0.1, 0.0), b(0.4, 0.3, 0.0), c(0.1, -0.5, 0.0), nowhere(0.9, 0.9, 0.0);

inline double distance(const Vec3& from, const Vec3& to) { return glm::distance(from, to); }

inline Scene ball_scene(int dimensions) {
  Scene scene = flat_scene({a});
  scene.system.dimensions = dimensions;
  scene.system.colliders = {{.shape = Sphere{{0.4, -0.3, 0.0}, 0.2}}, {.shape = Plane{{0.0, -0.8, 0.0}, {0.0, 1.0, 0.0}}}};
  return scene;
}

}  // namespace hooke
