// Moving air on rows of faces, by vectors.
#pragma once

#include <limits>

#include "sim/plan.h"

namespace hooke {

// f = A (a |u.n| (u.n) n + b |u_t| u_t) on a face, as in wind.cpp.
struct Wind {
  Vec3 velocity{0.0};                     // [m/s]
  double normal = 0.0, tangential = 0.0;  // [kg/m^3], a and b
};

// [m^4], of twice the area of a face: smaller ones feel no wind, since they have no direction that could be computed.
inline constexpr double min_square_of_area = std::numeric_limits<double>::min();

// Longer rows are taken in parts.
inline constexpr Index max_cells_at_once = 256;

// The number of cells in a row from the face `first` on, each of two faces
//   (i, j, i+1), (i+1, j, j+1)
// with i and j one larger than in the cell before: as in a cloth. 0: another face, or too few for vectors to pay.
Index count_cells(const Plan& plan, Index first);

// Adds the forces [N] on the faces of these cells to their corners, to the same bits as face by face.
void add_wind_on_cells(const Plan& plan, const Wind& wind, Index first, Index cells, const double* x, const double* v, double* f);

// [W], of these forces on the free points.
double wind_power_on_cells(const Plan& plan, const Wind& wind, Index first, Index cells, const double* x, const double* v);

}  // namespace hooke
