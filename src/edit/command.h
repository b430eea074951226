// Every edit is one small struct. Commands refer to points and springs by id. `apply` (apply.h) performs them and returns the inverse.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/placed.h"
#include "scene/scene.h"

namespace hooke {

struct Parameter;

// Adds points, springs and faces, in this order, each list in ascending order of index. Ids must be new or those of removed items.
struct Insert {
  std::vector<PlacedPoint> points;
  std::vector<PlacedSpring> springs;
  std::vector<PlacedFace> faces;
};

// Removes points with the springs and faces attached to them, springs, and faces. Ids that no longer exist are ignored. A grab of a
// removed point ends.
struct Remove {
  std::vector<PointId> points;
  std::vector<SpringId> springs;
  std::vector<Face> faces{};
};

// Nails or releases points and sets their velocity: 0 in an edit, which stops a nailed point; the previous one in its inverse.
struct SetNailed {
  struct Item {
    PointId point;
    bool nailed;
    Vec3 velocity{0.0};
  };
  std::vector<Item> items;
};

// Sets positions and velocities of points.
struct Move {
  struct Item {
    PointId point;
    Vec3 position;
    Vec3 velocity;
  };
  std::vector<Item> items;
};

// Sets the color of points, or removes it.
struct SetPointColor {
  std::vector<std::pair<PointId, std::optional<Color>>> values;
};

enum class PointProperty { Mass, Radius };
struct SetPointProperty {
  PointProperty property;
  std::vector<std::pair<PointId, double>> values;
};

enum class SpringProperty { Stiffness, Damping, RestLength, BreakStrain };
struct SetSpringProperty {
  SpringProperty property;
  std::vector<std::pair<SpringId, double>> values;
};

// Sets a parameter (parameters.h), clamped to its range.
struct SetParameter {
  const Parameter* parameter;
  double value;
};

// The same without clamping: restores a value that a file or an earlier edit set outside the range of the slider.
struct RestoreParameter {
  const Parameter* parameter;
  double value;
};

struct SetIntegrator {
  const Integrator* integrator;
};

// Grabs a point or, pulling, a position between three points. The whole drag is one step of the history: the inverse of the grab moves the
// points back to where they were grabbed.
struct GrabPoint {
  struct Item {
    PointId point{};
    std::optional<Patch> patch{};
    GrabKind kind = GrabKind::Pull;
    Vec3 target{0.0};          // [m]
    double stiffness = 100.0;  // [N/m], of a pull
  };
  Item grab;
};

// Grabs a collider by its anchor. Its inverse moves the colliders back.
struct GrabCollider {
  struct Item {
    Index collider = no_index;
    Vec3 target{0.0};  // [m]
  };
  Item grab;
};

// Moves what is grabbed towards the target in the coming frame; releases it.
struct MoveHand {
  Vec3 target;
};
struct ReleaseHand {};

// Set gravity and the whole list of colliders: the inverses of parameters that change several values at once.
struct SetGravity {
  Vec3 gravity;
};
struct SetColliders {
  std::vector<Collider> colliders;
};

// Replaces the list of forces: to switch, change, add or remove any of them.
struct SetForces {
  std::vector<Force> forces;
};

// The image of a texture (texture.h). An inverse restores the previous image and coordinates as a whole instead, because setting a texture
// assigns texture coordinates to points that have none.
struct TextureImage {
  std::shared_ptr<const Picture> picture;
  std::optional<ClothTexture> restored{};
};

// Sets the texture of the faces.
struct SetTexture {
  std::string texture;
  std::optional<double> size;  // [m]
  TextureImage image;
};

// Returns to another state of the same run: time, positions, velocities and tears.
struct GoToState {
  std::shared_ptr<const State> state;
};

// Sets the index of the latest tear (State::torn); 0 means intact.
struct SetTorn {
  std::uint32_t torn;
};

// Sets the index of the tear after an inverse of SetTorn or GoToState has restored the springs and faces.
struct MarkTorn {
  std::uint32_t torn;
};

// Replaces the whole scene, to return to the start and to undo that.
struct Replace {
  std::shared_ptr<const Scene> scene;
};

using Command = std::variant<Insert, Remove, SetNailed, Move, SetPointColor, SetPointProperty, SetSpringProperty, SetParameter,
                             RestoreParameter, SetIntegrator, GrabPoint, GrabCollider, MoveHand, ReleaseHand, SetGravity, SetColliders,
                             SetForces, SetTexture, GoToState, SetTorn, MarkTorn, Replace>;

// The name in the history: "nail 3 points".
std::string describe(const Command& command);

// Approximate memory use.
std::size_t bytes_of(const Command& command);

}  // namespace hooke
