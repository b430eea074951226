// How a scene asks to be looked at: kept by lab with the document, read by draw.
#pragma once

#include <optional>

#include "sim/system.h"

namespace hooke {

struct CameraPose {
  Vec3 eye{0.0, 0.0, 3.0};
  Vec3 target{0.0};
  std::optional<Vec3> up;   // none: opposite to gravity (y without gravity)
  bool orthographic = false;
  bool operator==(const CameraPose&) const = default;
};

struct ViewSettings {
  std::optional<CameraPose> camera;  // none: frames the scene
  std::optional<Color> background;   // none: the program's own
  bool operator==(const ViewSettings&) const = default;
};

}  // namespace hooke
