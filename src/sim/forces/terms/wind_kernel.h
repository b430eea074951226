// Moving air on rows of quads, by vectors.
#pragma once

#include <array>
#include <limits>
#include <numeric>
#include <vector>

#include "sim/plan/plan.h"

namespace hooke {

// f = A (a |u.n| (u.n) n + b |u_t| u_t) on a face or quad, as in wind.cpp.
struct Wind {
  Vec3 velocity{0.0};                     // [m/s]
  double normal = 0.0, tangential = 0.0;  // [kg/m^3], a and b
};

// [m/s], of the air at `time` [s], for values of the force `wind`.
Vec3 wind_at(const Plan& plan, const ForceValues& values, double time);

// [m^4], of twice the area of a face: smaller ones feel no wind, since they have no direction that could be computed.
inline constexpr double min_square_of_area = std::numeric_limits<double>::min();

// Longer rows of cells are taken in parts.
inline constexpr Index max_cells_at_once = 256;

// Rows of at least as many cells as pay for vectors, and at most max_cells_at_once.
std::vector<PanelRow> find_panel_rows(const std::vector<Panel<Index>>& panels);

// [W], on the cells at the same place of all rows: sums that do not depend on the width of vectors.
struct CellPowers {
  std::array<double, max_cells_at_once> of_cell{};
  double sum() const { return std::accumulate(of_cell.begin(), of_cell.end(), 0.0); }
};

// Adds the forces [N] on these cells to their corners, to the same bits as one by one, unless `f` is null; and their powers unless `power`
// is null.
void compute_wind_on_cells(const Plan& plan, const Wind& wind, const PanelRow& row, const double* x, const double* v, double* f,
                           CellPowers* power);

}  // namespace hooke
