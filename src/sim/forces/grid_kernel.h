// Springs of grids (sim/plan/grid.h), row by row in whole vectors, for the widest vector unit of the machine; the same bits on every
// machine. Either their forces alone, or forces, kick and drift in one pass over the points.
#pragma once

#include <array>
#include <span>

#include "sim/forces/grid_rows.h"
#include "sim/forces/kick.h"
#include "sim/plan/plan.h"

namespace hooke {

// Adds the force [N] of every spring of the grid to f; with dashpots if `v` is given.
void add_grid_forces(const Plan& plan, const Grid& grid, const double* x, const double* v, double* f);

// One pass over points: from the forces f at x, and those of dashpots at the velocity u,
//   a = g + f / m,   v' = kick of v,   x' = x + drift v',   w = prediction: a kick of v' by the same a.
// Nailed and held points keep their velocity; their a is zero.
template <class T>
struct LeapfrogPass {
  int dimensions = 3;
  Index stride = 0;                 // distance of the components of a field
  const T* inverse_mass = nullptr;  // [1/kg], per point; 0 if it is fixed
  std::array<T, 3> acceleration{};  // [m/s^2], g
  const T* x = nullptr;             // of the ends of springs
  T* drifted = nullptr;             // where x' goes, x itself; null: nowhere
  T* v = nullptr;                   // null: a alone is computed
  const T* u = nullptr;             // null: dashpots do not count
  const T* f = nullptr;             // [N], all forces but those of grids, in place of g; null: there are no others
  T* a = nullptr;                   // where a goes, which may be f; null: nowhere
  T* w = nullptr;                   // where w goes, which may be u; null: nowhere
  Kick<T> kick, prediction;
  T drift = 0;  // [s]
};
// That of the plan in double precision: no kick, nothing goes anywhere.
LeapfrogPass<double> pass_over(const Plan& plan, const Field& x);

// `count` passes one after another over all points, in place, with the forces of the springs of all grids. On the threads of the plan.
void advance(const Plan& plan, const LeapfrogPass<double>& pass, int count);
// The same for these grids, which are those of the plan, without dashpots.
void advance(const Plan& plan, std::span<const GridView<float>> grids, const LeapfrogPass<float>& pass, int count);

// One pass with the accelerations in pass.a, without forces.
void advance_with_known(const Plan& plan, const LeapfrogPass<double>& pass);

}  // namespace hooke
