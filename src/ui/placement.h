// A shape or a mesh that is shown in the scene before it is placed.
#pragma once

#include <string>

#include "scene/shape.h"

namespace hooke {

struct Placement {
  Shape shape;  // its place, its turn and, unless it is a mesh, what it is; no kind: nothing is being placed
  bool is_mesh = false;
  bool is_new = false;       // to be put where the view looks
  std::string mesh_path;     // as typed
  std::string mesh_info;     // what was loaded
  double mesh_size = 1.0;    // [m], of its longest side
  bool types_path = false;   // Enter ends the path
  bool wants_mesh = false;   // the mesh is to be loaded
  bool wants_place = false;  // it is to be placed

  bool is_on() const { return is_mesh || shape.kind != nullptr; }
  void stop() { *this = {}; }
};

}  // namespace hooke
