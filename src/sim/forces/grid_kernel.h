// Springs of grids (sim/plan/grid.h), row by row in whole vectors, for the widest vector unit of the machine; the same bits on every
// machine. Either their forces alone, or forces, kick and drift in one pass over the points.
#pragma once

#include <span>

#include "sim/plan/plan.h"

namespace hooke {

// Adds the force [N] of every spring of the grid to f; with dashpots if `v` is given.
void add_grid_forces(const Plan& plan, const Grid& grid, const double* x, const double* v, double* f);

// a = M^-1 (f + the force [N] of every spring of the grid) at the points of the grid, to the bits of add_grid_forces; gravity instead of f
// if it is null. f may be a.
void accelerate_grid(const Plan& plan, const Grid& grid, const double* x, const double* v, const double* f, double* a);

// One pass of a leapfrog: from the forces f at x (and, with `damped`, v) of all springs of the grid
//   a = acceleration + f / m,   v' = decay v + weight a,   x' = x + drift v'.
// Nailed and held points keep their velocity.
struct GridPass {
  double decay = 1.0, weight = 0.0, drift = 0.0;  // [1], [s], [s]
  bool damped = false;                            // whether the springs' dashpots count
  // The velocities at which dashpots act; null: v. And where decay' v' + weight' a goes, or null; it may be the same field.
  const double* dashpot_velocity = nullptr;
  double* predicted = nullptr;
  double predicted_decay = 1.0, predicted_weight = 0.0;  // [1], [s]
  const double* f = nullptr;                             // [N] of all other forces, in which case acceleration does not count
  // Where a goes, if it is needed. Then the forces are added as by add_grid_forces to f, or to acceleration m, to the same bits.
  double* a = nullptr;
  bool is_known = false;  // whether a is known and forces do not count: for points on which no force of a grid acts
};

// What the springs and points of a pass reached.
struct GridWatch {
  double max_speed_squared = 0.0;  // [m^2/s^2], of v'
  bool any_at_limit = false;       // whether a spring was as long as its limit before the pass; none without limits
};

// Rows of a grid; end < 0: up to the last one.
struct RowRange {
  Index begin = 0, end = -1;
};

// As many passes one after another as there are watches, at most max_grid_passes: each advances the points of the grid in place, and adds
// to its watch. On the threads of the plan. Or one pass over some rows, at least two unless the grid is shorter.
inline constexpr int max_grid_passes = 64;
void advance_grid(const Plan& plan, const Grid& grid, const GridPass& pass, double* x, double* v, std::span<GridWatch> watches,
                  const RowRange& rows = {});

// One pass over points first .. end - 1, on which no force of a grid acts.
void advance_points(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch);

}  // namespace hooke
