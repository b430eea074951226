// A small hanging net for tests of the laboratory, and what edits may change of it.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace hooke {

// A 4 x 4 net with a spacing of 0.1 m, its upper corners nailed, above a floor.
inline Scene small_net() {
  Scene scene;
  scene.name = "net";
  std::vector<PointId> points;
  for (int i = 0; i < 16; ++i) {
    const PointId id = scene.system.new_point_id();
    points.push_back(id);
    scene.system.append_point({.id = id, .nailed = i == 0 || i == 3, .mass = 0.01});
    const int row = i / 4, column = i % 4;
    scene.state.position.emplace_back(0.1 * column, -0.1 * row, 0.0);
    scene.state.velocity.emplace_back(0.0);
  }
  const auto attach = [&](int i, int j) {
    scene.system.append_spring(
        {.id = scene.system.new_spring_id(), .first = points[i], .second = points[j], .stiffness = 50.0, .rest_length = 0.1});
  };
  for (int i = 0; i < 16; ++i) {
    if (i % 4 < 3) attach(i, i + 1);
    if (i / 4 < 3) attach(i, i + 4);
  }
  scene.system.faces.push_back({{points[0], points[1], points[5]}});
  scene.system.colliders.push_back({.shape = Plane{.point = {0.0, -2.0, 0.0}}});
  return scene;
}

// What an edit may change and undo must restore; time is not included.
struct Content {
  System system;
  std::vector<Vec3> position, velocity;
  Settings settings;
  Defaults defaults;
  bool operator==(const Content&) const = default;
};

inline Content content_of(const Scene& scene) {
  return {scene.system, scene.state.position, scene.state.velocity, scene.settings, scene.defaults};
}

}  // namespace hooke
