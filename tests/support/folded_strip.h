// A strip that is built with folds, as its rest shape.
#pragma once

#include "sim/plan/hinges.h"
#include "support/bent_sheet.h"

namespace hooke {

// A strip of two rows, folded by `angle` [rad] across every second column, alternately to both sides, with the rest shape as built.
inline TestSim folded_strip(int columns, double angle, double stiffness, double sheet_stiffness, double damping_time = 0.0) {
  TestSim sim = flat_sheet({columns, 3}, stiffness, sheet_stiffness, Diagonals::Alternating, damping_time);
  Vec3 place(0.0);
  double slope = 0.5 * angle;
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < 3; ++row) {
      Vec3& x = sim.state.position[static_cast<std::size_t>(row * columns + column)];
      x = Vec3(place.x, place.y, x.z);
    }
    if (column % 2 == 1) slope = -slope;
    place += 0.1 * Vec3(std::cos(slope), std::sin(slope), 0.0);
  }
  sim.system.forces[0].values[2] = 1.0;
  set_rest_angles(sim.system, sim.state.position);
  return sim;
}

}  // namespace hooke
