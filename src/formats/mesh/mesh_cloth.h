// Cloth from a mesh: a point per vertex, springs along the edges and across the quads, with the material distributed so that the behavior
// hardly depends on the resolution of the mesh.
#pragma once

#include <string>
#include <vector>

#include "formats/mesh/clean_mesh.h"
#include "scene/scene.h"

namespace hooke {

// The material of the cloth.
struct SheetMaterial {
  double density = 0.2;    // [kg/m^2]
  double stiffness = 0.0;  // [N/m]: Young's modulus times thickness
  double damping = 0.0;    // [N s/m]
};

// A material that looks like cloth at any size [m]: hung from an edge it stretches by 1 % at the top under its own weight, and oscillations
// of the whole decay within a few periods.
SheetMaterial cloth_of_size(double size);

// Points, springs and faces of the mesh in its given position, and a floor below it. A line is a spring: a strip of the same material, a
// tenth of the size of the mesh wide. A point without a face and a line has the mass of a square of that width. An edge of more than two
// faces is one spring; their number is appended to `notes`. Throws InputError if there are more springs than file_limits.h allows. `file`
// is the name of the mesh in messages.
//
// Masses: a third of each adjacent triangle, a quarter of each adjacent quad. Stiffness of the springs, with area A and length l: E t
// sum(A) / l^2 over the triangles along an edge (Van Gelder 1998), which is exact for equilateral triangles; in a quad 3/8 E t A / l^2 for
// a side and 3/4 E t A / l^2 for a diagonal, which is an isotropic square of k = 3/4 E t with half of that on the diagonals. Dashpots
// likewise.
Scene make_cloth(CleanMesh mesh, const std::string& file, std::vector<std::string>& notes);

}  // namespace hooke
