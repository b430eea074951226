// A shape, a mesh or a collider with a preview in the scene before it is placed.
#pragma once

#include <optional>
#include <string>

#include "scene/shape.h"

namespace hooke {

struct Placement {
  Shape shape;  // its position, its rotation and, unless it is a mesh, its kind; without a kind nothing is being placed
  std::optional<Collider> collider;  // instead of a shape
  bool is_mesh = false;
  bool is_obstacle = false;  // the mesh: its points are nailed, and others touch its faces
  std::string mesh_path;     // as typed
  std::string mesh_info;     // about the mesh
  double mesh_size = 1.0;    // [m], length of the longest side
  // Of the mesh: [N/m] Young's modulus times thickness, [kg/m^2], [N s/m]. As for cloth of this size until they are set.
  double mesh_stiffness = 0.0, mesh_density = 0.0, mesh_damping = 0.0;

  bool is_on() const { return is_mesh || collider || shape.kind != nullptr; }
  void stop() { *this = {}; }
};

}  // namespace hooke
