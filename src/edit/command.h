// Every edit, one small struct each. Commands speak in ids; `apply` (apply.h) is the only place where they act, and it
// returns the inverse.
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

// Adds points, springs and faces, in this order; each list in ascending places. Ids must be new or those of removed things.
struct Insert {
  std::vector<PlacedPoint> points;
  std::vector<PlacedSpring> springs;
  std::vector<PlacedFace> faces;
};

// Removes points with the springs and faces on them, springs, and faces. What is gone is passed over. A grab on a
// removed point is let go.
struct Remove {
  std::vector<PointId> points;
  std::vector<SpringId> springs;
  std::vector<Face> faces{};
};

// Nails or frees points; a nailed point stops. `velocity`, when given (by an inverse), is what a freed point gets.
struct SetNailed {
  struct Item {
    PointId point;
    bool nailed;
    Vec3 velocity{0.0};
  };
  std::vector<Item> items;
};

// Puts points somewhere, with a velocity of their own.
struct Move {
  struct Item {
    PointId point;
    Vec3 position;
    Vec3 velocity;
  };
  std::vector<Item> items;
};

// Gives points a colour of their own, or takes it away.
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

// Sets a parameter of the table (parameters.h), clamped to its range.
struct SetParameter {
  const Parameter* parameter;
  double value;
};

// The same without the clamp: gives back a value that a file or an earlier edit held, whatever the slider's range.
struct RestoreParameter {
  const Parameter* parameter;
  double value;
};

struct SetIntegrator {
  const Integrator* integrator;
};

// Grabs a point or, pulling, a place between three points. The whole drag is one step of the history: the inverse of the grab moves the
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

// Gravity, and the colliders as a list: what an inverse needs when a parameter changed their sizes.
struct SetGravity {
  Vec3 gravity;
};
struct SetColliders {
  std::vector<Collider> colliders;
};

// The listed forces as a whole: switched, set, added or taken away.
struct SetForces {
  std::vector<Force> forces;
};

// Another texture on the faces; `picture` is what it names (texture.h).
struct SetTexture {
  std::string texture;
  std::optional<double> size;  // [m]
  std::shared_ptr<const Picture> picture;
};

// Puts everything where it was at another moment of the same run, its time too, and as torn as it was then.
struct GoToState {
  std::shared_ptr<const State> state;
};

// Makes the scene as torn as it was after this one of its tears (Scene::tears); 0: whole.
struct SetTorn {
  std::uint32_t torn;
};

// Replaces the whole scene: back to the start, or what was there before that.
struct Replace {
  std::shared_ptr<const Scene> scene;
};

using Command = std::variant<Insert, Remove, SetNailed, Move, SetPointColor, SetPointProperty, SetSpringProperty, SetParameter,
                             RestoreParameter, SetIntegrator, GrabPoint, GrabCollider, MoveHand, ReleaseHand, SetGravity, SetColliders,
                             SetForces, SetTexture, GoToState, SetTorn, Replace>;

// What a person calls it: "nail 3 points".
std::string describe(const Command& command);

// What it takes of memory, about.
std::size_t bytes_of(const Command& command);

}  // namespace hooke
