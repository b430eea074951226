// Sheets with bending stiffness: flat, bent to a cylinder, and clamped.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/terms/rows.h"
#include "support/test_sim.h"

namespace hooke {

enum class Diagonals { Falling, Rising, Alternating };

struct SheetSize {
  int columns = 9, rows = 5;
  double a = 0.1, b = 0.1;  // [m], of a cell
};

// A sheet in the plane y = 0 of mass 0.1 kg/m^2, with springs along the threads and both diagonals.
inline TestSim flat_sheet(const SheetSize& size, double stiffness, double sheet_stiffness, Diagonals diagonals = Diagonals::Falling,
                          double damping_time = 0.0) {
  TestSim sim;
  const auto at = [&](int column, int row) { return sim.system.points()[row * size.columns + column].id; };
  for (int row = 0; row < size.rows; ++row)
    for (int column = 0; column < size.columns; ++column) {
      const double sides = (column == 0 || column == size.columns - 1 ? 0.5 : 1.0) * (row == 0 || row == size.rows - 1 ? 0.5 : 1.0);
      sim.add({column * size.a, 0.0, row * size.b}, 0.1 * size.a * size.b * sides);
    }
  const auto join = [&](PointId first, PointId second) {
    const double length = glm::distance(sim.position(first), sim.position(second));
    sim.join(first, second, sheet_stiffness, length);
  };
  for (int row = 0; row < size.rows; ++row)
    for (int column = 0; column < size.columns; ++column) {
      if (column + 1 < size.columns) join(at(column, row), at(column + 1, row));
      if (row + 1 < size.rows) join(at(column, row), at(column, row + 1));
      if (column + 1 == size.columns || row + 1 == size.rows) continue;
      const PointId p = at(column, row), q = at(column + 1, row), r = at(column, row + 1), s = at(column + 1, row + 1);
      join(q, r);
      join(p, s);
      const bool falls = diagonals == Diagonals::Falling || (diagonals == Diagonals::Alternating && (row + column) % 2 == 0);
      for (const auto& face :
           falls ? std::array{std::array{p, r, q}, std::array{q, r, s}} : std::array{std::array{p, r, s}, std::array{p, s, q}})
        sim.system.faces.push_back({face});
    }
  sim.system.forces = {{.term = &bending_force, .values = {stiffness, damping_time}}};
  return sim;
}

// Bends it to a cylinder of this curvature [1/m]; the direction of bending has this angle to the rows.
inline void bend(TestSim& sim, double curvature, double angle) {
  const Vec3 along(std::cos(angle), 0.0, std::sin(angle)), axis(-along.z, 0.0, along.x);
  for (Vec3& x : sim.state.position) {
    const double s = curvature * glm::dot(x, along);
    x = glm::dot(x, axis) * axis + std::sin(s) / curvature * along + Vec3(0.0, (1.0 - std::cos(s)) / curvature, 0.0);
  }
}

// A strip of two rows whose first two columns are nailed. Nothing bends beyond the middle of its last cell, and the hinge on the second
// column stands for the half cells on either side of it: its length is 1 m from the middle of the first cell.
inline TestSim clamped_strip(int columns, double stiffness, double sheet_stiffness, Diagonals diagonals = Diagonals::Falling) {
  const double a = 1.0 / (columns - 1.5);
  TestSim sim = flat_sheet({columns, 2, a, a}, stiffness, sheet_stiffness, diagonals);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = i % columns < 2;
  return sim;
}

}  // namespace hooke
