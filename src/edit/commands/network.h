// Commands that add and remove points, springs and faces.
#pragma once

#include <optional>
#include <string>

#include "edit/effect.h"
#include "scene/placed.h"

namespace hooke {

// Adds points, springs and faces, in this order, each list in ascending order of index. Ids must be new or those of removed items. Where
// nothing touches in the scene, `contact` becomes its contact.
struct Insert {
  static constexpr std::string_view name = "insert";
  static constexpr auto fields = names("points", "springs", "faces", "contact");
  std::vector<PlacedPoint> points;
  std::vector<PlacedSpring> springs;
  std::vector<PlacedFace> faces;
  std::optional<PairContact> contact{};

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

// Removes points with the springs and faces attached to them, springs, and faces. Ids that no longer exist are ignored. A grab of a
// removed point ends.
struct Remove {
  static constexpr std::string_view name = "remove";
  static constexpr auto fields = names("points", "springs", "faces");
  std::vector<PointId> points;
  std::vector<SpringId> springs;
  std::vector<Face> faces{};

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

}  // namespace hooke
