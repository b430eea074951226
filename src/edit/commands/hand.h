// Commands of the hand: grab, move, release.
#pragma once

#include <optional>
#include <string>

#include "edit/effect.h"

namespace hooke {

// Grabs a point or, pulling, a position between three points. The whole drag is one step of the history: the inverse of the grab moves the
// points back to where they were grabbed. Undo in Lab returns to the state before the grab, all points included.
struct GrabPoint {
  struct Item {
    static constexpr auto fields = names("point", "patch", "kind", "target", "stiffness");
    PointId point{};
    std::optional<Patch> patch{};
    GrabKind kind = GrabKind::Pull;
    Vec3 target{0.0};          // [m]
    double stiffness = 100.0;  // [N/m], of a pull
  };
  static constexpr std::string_view name = "grab";
  static constexpr auto fields = names("grab");
  Item grab;

  std::string describe() const { return grab.patch ? "drag the cloth" : "drag a point"; }
  Inverse apply(Scene& scene, Effect& effect) const;
};

// Grabs a collider by its anchor. Its inverse moves the colliders back.
struct GrabCollider {
  struct Item {
    static constexpr auto fields = names("collider", "target");
    Index collider = no_index;
    Vec3 target{0.0};  // [m]
  };
  static constexpr std::string_view name = "grab_collider";
  static constexpr auto fields = names("grab");
  Item grab;

  std::string describe() const { return "drag a collider"; }
  Inverse apply(Scene& scene, Effect& effect) const;
};

// Moves what is grabbed towards the target in the coming frame; releases it.
struct MoveHand {
  static constexpr std::string_view name = "move_hand";
  static constexpr auto fields = names("target");
  Vec3 target;

  std::string describe() const { return "move the hand"; }
  Inverse apply(Scene& scene, Effect& effect) const;
};
struct ReleaseHand {
  static constexpr std::string_view name = "release_hand";
  static constexpr auto fields = names();

  std::string describe() const { return "release"; }
  Inverse apply(Scene& scene, Effect& effect) const;
};

// The points that a grab acts on.
std::vector<PointId> points_of(const Grab& grab);

}  // namespace hooke
