// What a scene is: points, springs, faces, colliders, forces and what the hand holds. Constant while a step runs; changed only by
// edit's apply (commands) and by the scene loader.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/color.h"
#include "base/types.h"
#include "sim/model/face_list.h"
#include "sim/model/force_term.h"
#include "sim/model/spring_list.h"

namespace hooke {

struct Point {
  PointId id{};
  bool nailed = false;
  std::uint8_t fixed_axes = 0;  // a roller: the sum of 1, 2 and 4 if it does not move along x, y and z
  std::optional<Color> color;   // none: by state (nailed yellow, selected red)
  double mass = 1.0;            // [kg], > 0
  double radius = 0.02;         // [m], >= 0: for drawing, and the distance at which it touches a collider
  Vec3 load{0.0};               // [N], a constant force on it
  bool is_plain() const { return fixed_axes == 0 && load == Vec3(0.0); }
  bool is_fixed_along(int axis) const { return (fixed_axes >> axis & 1) != 0; }
  bool operator==(const Point&) const = default;
};

// The fixed axes of a point in words, "xz", and back; none if it is another text.
std::string axes_text(std::uint8_t fixed_axes);
std::optional<std::uint8_t> axes_of(std::string_view text);

// The part of the velocity with which a point moves: nothing of a nail, and nothing along fixed axes.
inline Vec3 velocity_of(const Point& point, Vec3 velocity) {
  for (int axis = 0; axis < 3; ++axis)
    if (point.nailed || point.is_fixed_along(axis)) velocity[axis] = 0.0;
  return velocity;
}

struct Plane {
  Vec3 point{0.0};
  Vec3 normal{0.0, 1.0, 0.0};  // unit; points to the free side
  bool operator==(const Plane&) const = default;
};

struct Sphere {
  Vec3 center{0.0};
  double radius = 1.0;  // [m], > 0
  bool operator==(const Sphere&) const = default;
};

// Axis-aligned, solid inside.
struct Box {
  Vec3 min{-1.0};
  Vec3 max{1.0};
  // The bits 1, 2 and 4: on the side of the maximum along x, y and z.
  Vec3 corner(int bits) const { return {bits & 1 ? max.x : min.x, bits & 2 ? max.y : min.y, bits & 4 ? max.z : min.z}; }
  bool operator==(const Box&) const = default;
};

// The motion of a collider: the shape oscillates about its rest position, or only its surface moves, as that of a spinning ball or of a
// conveyor belt.
struct ColliderPath {
  Vec3 amplitude{0.0};                   // [m]: the displacement is amplitude sin(2 pi frequency t + phase)
  double frequency = 1.0;                // [1/s], >= 0
  double phase = 0.0;                    // [rad]
  Vec3 spin{0.0};                        // [rad/s], about the center of a sphere, or the point of a plane, along its normal; not for boxes
  Vec3 belt{0.0};                        // [m/s], of the surface; only its tangential part counts
  Vec3 offset(double time) const;        // [m]
  Vec3 velocity(double time) const;      // [m/s], of the shape
  Vec3 acceleration(double time) const;  // [m/s^2], of it
  double resolving_step() const;         // [s], the longest that resolves the oscillation; infinity: it does not oscillate
  bool moves() const { return *this != ColliderPath{.frequency = frequency, .phase = phase}; }
  bool operator==(const ColliderPath&) const = default;
};

using ColliderShape = std::variant<Plane, Sphere, Box>;

struct Collider {
  ColliderShape shape;
  double restitution = 0.0;  // [1], 0..1: normal speed after / before
  double friction = 0.0;     // [1], >= 0: Coulomb's mu
  bool solid = true;         // false: drawn only
  // A plane at rest that acts as a wall of XSpringies (contact/contact.h).
  bool one_way = false;
  ColliderPath path{};
  bool operator==(const Collider&) const = default;
};

// Contact between points: spheres of their radii, which touch at a distance of both radii and the thickness. Points joined by a spring that
// would touch at its rest length do not. Contact of faces, and of springs that are not between points of faces: they touch at a distance of
// the thickness.
struct PairContact {
  bool points = false, springs = false, faces = false;
  double thickness = 0.0;    // [m], >= 0
  double restitution = 0.0;  // [1], 0..1: normal speed after / before
  double friction = 0.3;     // [1], >= 0: Coulomb's mu
  // Overlaps of faces and springs are removed as by a spring and a dashpot with these values and the mass that the contact moves.
  double frequency = 30.0;     // [Hz], > 0
  double damping_ratio = 1.0;  // [1], > 0
  bool any() const { return points || springs || faces; }
  bool operator==(const PairContact&) const = default;
};

// The same shape moved by `displacement` [m], and the collider where its path has taken it by `time` [s].
ColliderShape translated(ColliderShape shape, const Vec3& displacement);
Collider translated(Collider collider, const Vec3& displacement);
Collider collider_at_time(const Collider& collider, double time);
// The point that a hand drags it by: the center of a sphere or box, the point of a plane.
Vec3 anchor_of(const ColliderShape& shape);
inline Vec3 anchor_of(const Collider& collider) { return anchor_of(collider.shape); }

enum class GrabKind {
  Hold,  // the point follows the target exactly
  Pull,  // a spring of zero rest length between point and target
};

// A position between three different points, such as one on a face: the sum of weight times position; weights are at least 0 and sum to 1.
struct Patch {
  std::array<PointId, 3> points{};
  std::array<double, 3> weights{1.0, 0.0, 0.0};
  bool operator==(const Patch&) const = default;
};

// What the hand holds: at most one point, or one position between points. Its motion is in the State (Hand).
struct Grab {
  PointId point{};
  std::optional<Patch> patch{};  // pulled instead of the point, which is one of the three
  GrabKind kind = GrabKind::Pull;
  double stiffness = 100.0;  // [N/m], if it pulls
  bool operator==(const Grab&) const = default;
};

// A hand of the scene file: it holds a point, moves it along a circle, and releases it. Its position is a function of time, so
// that a scene can be saved, rewound and replayed while it is active (hand.h).
struct ScriptedHand {
  PointId point{};
  Vec3 from{0.0};            // [m], position at `begin`
  Vec3 center{0.0};          // [m]
  Vec3 axis{0.0, 0.0, 1.0};  // unit; the motion is counter-clockwise about it
  double speed = 0.0;        // [m/s]
  double begin = 0.0;        // [s], of the scene time
  double seconds = 0.0;      // [s], duration of the grab
  bool operator==(const ScriptedHand&) const = default;
};

// What may be switched off without losing its values.
struct Switches {
  bool drag = true;
  bool dashpots = true;                                                // false: the damping of every spring counts as zero
  std::array<bool, spring_families> families{true, true, true, true};  // false: its springs are ignored
  bool operator==(const Switches&) const = default;
};

// The indices of items in their list by id, and the next id to assign. Ignored in comparisons: the indices follow from the list, and ids
// assigned but not used do not make two scenes different.
struct IdTable {
  std::vector<Index> index_by_id;  // empty: the id of each item is its index
  std::uint32_t next_id = 0;
  // no_index if none of the `count` items has the id.
  Index find(std::uint32_t id, std::size_t count) const {
    if (index_by_id.empty()) return id < count ? static_cast<Index>(id) : no_index;
    return id < index_by_id.size() ? index_by_id[id] : no_index;
  }
  bool operator==(const IdTable&) const { return true; }
};

struct IdTables {
  IdTable points, springs;
  bool operator==(const IdTables&) const = default;
};

// Properties are plain fields. Points and springs are added and removed only through the functions below, which keep the
// lookup by id valid. Two systems are equal if all fields are; unused ids do not count.
class System {
 public:
  int dimensions = 3;             // 2: everything stays in the plane z = 0
  Vec3 gravity{0.0, -9.81, 0.0};  // [m/s^2]
  double drag = 0.0;              // [1/s]: point damping, acceleration -drag (v - wind)
  Switches switches;
  Vec3 wind{0.0};  // [m/s], velocity of the air for the drag
  FaceList faces;
  std::vector<Collider> colliders;
  PairContact contact;
  std::vector<Force> forces;  // besides gravity, springs, dashpots and drag
  // Which forces towards a center have there, and act on all others, without a reaction. None, or no such point: their own.
  std::optional<PointId> center_point;
  std::optional<Grab> grab;
  double hand_speed = 0.0;                    // [m/s], speed limit of the hand; 0: none
  double break_strain = 0.0;                  // [1], of all springs, in addition to their own; 0: none
  MuscleClock muscles;                        // of springs whose rest length moves
  double strain_limit = 0.0;                  // [1], maximum strain of every spring, enforced after each step; 0: none
  std::optional<ScriptedHand> scripted_hand;  // inactive while there is a grab

  const std::vector<Point>& points() const { return points_; }
  const SpringList& springs() const { return springs_; }
  Index point_count() const { return static_cast<Index>(points_.size()); }
  Index spring_count() const { return static_cast<Index>(springs_.size()); }

  // Index of a point or spring by its id; no_index if it does not exist.
  Index index_of(PointId id) const { return ids_.points.find(static_cast<std::uint32_t>(id), points_.size()); }
  Index index_of(SpringId id) const { return ids_.springs.find(static_cast<std::uint32_t>(id), springs_.size()); }

  // For changing properties, except ids and a spring's ends and family. The index must be valid.
  Point& point(Index index) { return points_[index]; }
  SpringEdit spring(Index index) { return {springs_, static_cast<std::size_t>(index)}; }

  // The next ids, and the same while taking them.
  std::uint32_t next_point_id() const { return ids_.points.next_id; }
  std::uint32_t next_spring_id() const { return ids_.springs.next_id; }
  PointId new_point_id() { return PointId{ids_.points.next_id++}; }
  SpringId new_spring_id() { return SpringId{ids_.springs.next_id++}; }
  // Ids assigned before (undo restores removed points) are accepted; new ids are greater than all ids seen so far.
  void append_point(const Point& point);
  void append_spring(const Spring& spring);
  // Replaces the whole list. Ids must be unique; the ends of a spring must exist.
  void set_points(std::vector<Point> points);
  void set_springs(SpringList springs);
  void reserve(Index points, Index springs);

  bool operator==(const System& other) const = default;

  // Number of springs of the family.
  Index count_of(SpringFamily family) const { return family_count_[static_cast<std::size_t>(family)]; }

  // Effective drag, stiffness and damping, with the switches applied.
  double drag_rate() const { return switches.drag ? drag : 0.0; }
  bool is_on(const Spring& spring) const { return switches.families[static_cast<std::size_t>(spring.family)]; }
  double stiffness_of(const Spring& spring) const { return is_on(spring) ? spring.stiffness : 0.0; }
  // The same for bounds on frequencies and on steps: the largest derivative of its force.
  double stiffness_bound_of(const Spring& spring) const {
    return spring.law ? max_stiffness(*spring.law, stiffness_of(spring), spring.rest_length) : stiffness_of(spring);
  }
  // [m], at a time of the scene.
  double rest_length_of(const Spring& spring, double time) const {
    return spring.law ? rest_length_at(*spring.law, spring.rest_length, muscles.at(time)).length : spring.rest_length;
  }
  // [m], the length at which it breaks. Without a rest length, break_strain is that length.
  double break_length_of(const Spring& spring) const {
    const double strain = break_strain > 0.0 ? std::min(break_strain, spring.break_strain) : spring.break_strain;
    return spring.rest_length > 0.0 ? spring.rest_length * (1.0 + strain) : strain;
  }
  // Whether any spring has a strain at which it breaks.
  bool any_spring_breaks() const;
  double damping_of(const Spring& spring) const { return switches.dashpots && is_on(spring) ? spring.damping : 0.0; }

 private:
  std::vector<Point> points_;
  SpringList springs_;
  IdTables ids_;
  std::array<Index, spring_families> family_count_{};
};

// Whether anything of the scene can touch: points each other, or a solid collider.
bool has_contact(const System& system);

}  // namespace hooke
