// Cloth from a mesh: a point a vertex, springs along the edges and across the quads, the material spread over them so that
// it hardly matters how finely the mesh is cut.
#pragma once

#include <string>
#include <vector>

#include "formats/mesh/clean_mesh.h"
#include "scene/scene.h"

namespace hooke {

// What the mesh is made of.
struct SheetMaterial {
  double density = 0.2;    // [kg/m^2]
  double stiffness = 0.0;  // [N/m]: Young's modulus times thickness
  double damping = 0.0;    // [N s/m]
};

// A material that looks like cloth whatever the size of the thing [m]: hung up by an edge it stretches by 1 % at the top
// under its own weight, and what swings at the size of the whole dies away over some swings.
SheetMaterial cloth_of_size(double size);

// Points, springs and faces of the mesh, lying as drawn, and a floor under it. An edge of more than two faces is one
// spring; how many there are is appended to `notes`. Throws InputError when there are more springs than file_limits.h allows.
// `file` stands for the mesh in messages.
//
// Masses: a third of each triangle's, a quarter of each quad's. Stiffness of the springs, by A the area and l the length:
// E t sum(A) / l^2 over the triangles along an edge (Van Gelder 1998), which is exact for equilateral ones; in a quad
// 3/8 E t A / l^2 for a side and 3/4 E t A / l^2 for a diagonal, which is an isotropic square of k = 3/4 E t and half of
// that across. Dashpots likewise.
Scene make_cloth(CleanMesh mesh, const std::string& file, std::vector<std::string>& notes);

}  // namespace hooke
