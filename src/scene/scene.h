// A document: everything that a scene file holds, ready to run.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/placed.h"
#include "scene/sheet_weights.h"
#include "scene/view_settings.h"
#include "sim/settings.h"
#include "sim/state.h"
#include "sim/system.h"

namespace hooke {

// Values that a new point or spring gets from the tools.
struct Defaults {
  double mass = 1.0;            // [kg]
  double radius = 0.02;         // [m]
  double stiffness = 100.0;     // [N/m]
  double damping = 0.0;         // [N s/m]
  double pull_stiffness = 0.0;  // [N/m], of the pulling hand; 0: chosen from the grabbed point's springs
  GrabKind grab = GrabKind::Hold;
  bool mass_follows_radius = false;  // whether a point whose radius is set gets mass in proportion to its square
  bool operator==(const Defaults&) const = default;
};

// In which numbers the sliders speak of the springs. Whatever is chosen, each spring has its own k and d, which they set.
enum class SpringParameterization : std::uint8_t {
  Plain,      // k and d of each spring
  PerStrain,  // k = Y / l0; d of each spring
  BySize,     // k of each spring; d = c l0: in quads half as wide, half of it
  Material,   // of the sheet, however many points it has: k = E t share, d = eta share, mass = density area
};

// What broke in one frame of a run, and what broke before it: from the whole scene, tears branch where somebody went back and
// let it go on otherwise.
struct Tear {
  std::uint32_t before = 0;  // the tear that this one came after (State::torn)
  std::vector<PlacedSpring> springs;
  std::vector<PlacedFace> faces;
};

// What the arrow keys and sliders of a scene step by, where the scene says so.
struct ControlRanges {
  double stiffness_min = 0.0, stiffness_max = 0.0, stiffness_step = 0.0;  // [N/m]; most = 0: the parameter's own
  bool operator==(const ControlRanges&) const = default;
};

// The parts of a file that are kept as text: what made the last points, springs and faces, and keys that are not ours.
struct PreservedJson {
  using Members = std::string;                    // "\"a\": 1, \"b\": [2]": members without the braces
  std::string generators;                         // the list as it stood; empty: none
  std::string check;                              // the object as it stood (scene_check.h); empty: none
  std::string gallery;                            // the object as it stood (gallery.h); empty: none
  Members unknown;                                // at the top
  std::map<std::string, Members> unknown_inside;  // in an object: "simulation", "view.camera", "colliders[0]"
  std::map<PointId, Members> unknown_of_points;
  std::map<SpringId, Members> unknown_of_springs;
  bool operator==(const PreservedJson&) const = default;
};

struct Scene {
  std::string name;
  std::string description;
  System system;
  State state;
  Settings settings;
  ViewSettings view;
  ClothTexture cloth_texture;
  Defaults defaults;
  SpringParameterization parameterization = SpringParameterization::Plain;
  std::shared_ptr<const SheetWeights> sheet;       // null: there is no cloth
  std::vector<std::shared_ptr<const Tear>> tears;  // of the run, in the order in which they happened; state.torn counts from 1
  ControlRanges controls;
  PreservedJson preserved_json;
  std::uint64_t revision = 0;  // of everything but the state; apply alone increments it, and what is derived from a scene is cached by it
};

// What the point weighs with another radius, its mass going with the square of it; as before without any.
inline double mass_at_radius(const Point& point, double radius) {
  const double ratio = radius / point.radius;
  return point.radius > 0.0 && radius > 0.0 ? point.mass * ratio * ratio : point.mass;
}

// A flat stage with a floor, to build on.
Scene empty_scene();

}  // namespace hooke
