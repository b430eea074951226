// The document: everything that a scene file contains, ready to run.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/placed.h"
#include "scene/sheet_weights.h"
#include "scene/view_settings.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

// Properties of new points and springs.
struct Defaults {
  double mass = 0.0;            // [kg]; 0: chosen from the points of the scene
  double radius = 0.0;          // [m]; 0: chosen from the points of the scene
  double stiffness = 100.0;     // [N/m]
  double damping = 0.0;         // [N s/m]
  double pull_stiffness = 0.0;  // [N/m], of the drag spring; 0: chosen from the springs of the point
  GrabKind grab = GrabKind::Hold;
  int law = 0;                       // of springs that are added, a number of new_springs
  bool mass_follows_radius = false;  // whether setting the radius of a point scales its mass by its square
  bool operator==(const Defaults&) const = default;
};

// The parameterization of the springs by the sliders. Each spring keeps its own k and d.
enum class SpringParameterization : std::uint8_t {
  Plain,      // k and d of each spring
  PerStrain,  // k = Y / l0; d of each spring
  BySize,     // k of each spring; d = c l0: half as much in quads half as wide
  Material,   // of the sheet, for any number of points: k = E t weight, d = eta weight, mass = density area
};

// The items that broke in one frame of a run, and the preceding tear. Tears form a tree rooted at the intact scene, with a branch wherever
// the user went back in time and the run continued differently.
struct Tear {
  std::uint32_t before = 0;  // the preceding tear (State::torn)
  std::vector<PlacedSpring> springs;
  std::vector<PlacedFace> faces;
};

// Range and step of the stiffness keys and sliders, if the scene gives them.
struct ControlRanges {
  double stiffness_min = 0.0, stiffness_max = 0.0, stiffness_step = 0.0;  // [N/m]; max = 0: those of the parameter
  bool operator==(const ControlRanges&) const = default;
};

// The parts of a file that are preserved as text: generators of the last points, springs and faces, and unknown keys.
struct PreservedJson {
  using Members = std::string;                    // "\"a\": 1, \"b\": [2]": members without the braces
  std::string generators;                         // the list as in the file; empty: none
  std::string check;                              // the object as in the file (scene_check.h); empty: none
  std::string gallery;                            // the object as in the file (gallery.h); empty: none
  Members unknown;                                // at the top
  std::map<std::string, Members> unknown_inside;  // in an object: "simulation", "view.camera", "colliders[0]"
  std::map<PointId, Members> unknown_of_points;
  std::map<SpringId, Members> unknown_of_springs;
  bool operator==(const PreservedJson&) const = default;
};

struct Scene {
  std::string name;
  std::string description;
  std::string notes;  // of the user
  System system;
  State state;
  Settings settings;
  ViewSettings view;
  ClothTexture cloth_texture;
  Defaults defaults;
  SpringParameterization parameterization = SpringParameterization::Plain;
  std::shared_ptr<const SheetWeights> sheet;       // null: there is no cloth
  std::vector<std::shared_ptr<const Tear>> tears;  // of the run, in order of occurrence; state.torn counts from 1
  ControlRanges controls;
  PreservedJson preserved_json;
  std::uint64_t revision = 0;  // of everything except the state; only apply increments it, and caches of derived data depend on it
};

// The mass of the point with another radius, proportional to its square; unchanged if either radius is 0.
inline double mass_at_radius(const Point& point, double radius) {
  const double ratio = radius / point.radius;
  return point.radius > 0.0 && radius > 0.0 ? point.mass * ratio * ratio : point.mass;
}

// A new scene: empty, with a floor, in 2 or 3 dimensions, the method `auto`, and properties of new parts with which a truss stands.
Scene empty_scene(int dimensions = 2);

}  // namespace hooke
