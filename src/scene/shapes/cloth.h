// A cloth: a grid of points with springs along its rows and columns, on the diagonals of its cells, and to every second next point.
#pragma once

#include "scene/shapes/fabric.h"

namespace hooke {

// columns x rows points, row by row from `corner`, along `across` first. Structural, shear (diagonal) and bend springs (to the second next
// point) according to the stencil; two faces per cell.
struct Cloth {
  Vec3 corner{0.0}, across{1.0, 0.0, 0.0}, down{0.0, -1.0, 0.0};  // [m]: a corner, and the two edges from it, as vectors
  std::int64_t columns = 2, rows = 2;
  Fabric fabric{.mass_model = MassModel::Tributary};
  std::optional<std::int64_t> stencil;  // 4: structural, 8: and shear, 12: and bend; none: the families with stiffness
  // for a material, instead of stiffness and damping: Young's modulus times thickness [N/m], and viscosity times thickness [N s/m]
  std::optional<double> sheet_stiffness;
  double sheet_damping = 0.0;
  std::optional<double> shear_stiffness;  // [N/m]; none: half of the stiffness
  std::optional<double> bend_stiffness;   // [N/m]; none: half of the stiffness in a stencil of 12, else 0
};

ElementCount element_count_of(const Cloth& cloth);
void generate(const Cloth& cloth, Network& network);

}  // namespace hooke
