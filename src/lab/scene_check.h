// A scene's own check: that it runs as it is set.
#pragma once

#include <string>

#include "lab/scene.h"

namespace hooke {

enum class SceneEnd { Finite, StopsOpenly };

struct SceneCheck {
  bool passed = false;
  std::string measured;  // one line: what became of it, and what speaks against it
};

// Steps the scene under its own method: `seconds` [s] through to the end, every state finite; or, for one that is there to
// be seen fail, until the watch stops it within a hundred times as long, with the culprit named and the last good state kept.
SceneCheck check_scene(const Scene& scene, SceneEnd expected, double seconds);

// What a shipped scene is meant to do.
SceneEnd expected_end(const std::string& id);

}  // namespace hooke
