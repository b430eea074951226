// Sheets of N x N points on which the methods are measured.
#pragma once

#include <numbers>

#include "support/test_sim.h"

namespace hooke {

namespace sheet {

inline Index at(int n, int row, int column) { return row * n + column; }

inline void join(TestSim& sim, Index first, Index second, double k, double d, double rest_length) {
  sim.join(sim.system.points()[first].id, sim.system.points()[second].id, k, rest_length, d);
}

// springs right and down, and optionally both diagonals, with the lengths of the undeformed sheet of 1 m
inline void join_neighbors(TestSim& sim, int n, double k, double k_diagonal, double d) {
  const double a = 1.0 / (n - 1), diagonal = std::numbers::sqrt2 * a;
  sim.system.reserve(n * n, 4 * n * n);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const Index here = at(n, row, column);
      if (column + 1 < n) join(sim, here, at(n, row, column + 1), k, d, a);
      if (row + 1 < n) join(sim, here, at(n, row + 1, column), k, d, a);
      if (k_diagonal == 0.0 || row + 1 == n) continue;
      if (column + 1 < n) join(sim, here, at(n, row + 1, column + 1), k_diagonal, d, diagonal);
      if (column > 0) join(sim, here, at(n, row + 1, column - 1), k_diagonal, d, diagonal);
    }
}

}  // namespace sheet

// 1 m x 1 m, vertical, 1 kg distributed equally over the points, the top row nailed, springs k [N/m] and dashpots d [N s/m] right and down;
// starts in hanging equilibrium with v_z = s (1 + cos(pi u)) / 4 [m/s], s below the top row, u to the right. It swings under tension, which
// is smooth and predictable motion.
inline TestSim net(int n, double k, double d) {
  TestSim sim;
  const double a = 1.0 / (n - 1), m = 1.0 / (n * n);
  double y = 0.0;
  for (int row = 0; row < n; ++row) {
    if (row > 0) y -= a + (n - row) * m * 9.81 / k;
    for (int column = 0; column < n; ++column) {
      const double u = a * column, s = a * row;
      const PointId id = sim.add({u, y, 0.0}, m, {0.0, 0.0, 0.25 * s * (1.0 + std::cos(std::numbers::pi * u))});
      sim.system.point(sim.system.index_of(id)).nailed = row == 0;
    }
  }
  sheet::join_neighbors(sim, n, k, 0.0, d);
  return sim;
}

// The same but undeformed and with diagonals, v_z = s (1 + cos(pi u)) / 2: it buckles.
inline TestSim curtain(int n, double k, double d) {
  TestSim sim;
  const double a = 1.0 / (n - 1), m = 1.0 / (n * n);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const double u = a * column, s = a * row;
      const PointId id = sim.add({u, -s, 0.0}, m, {0.0, 0.0, 0.5 * s * (1.0 + std::cos(std::numbers::pi * u))});
      sim.system.point(sim.system.index_of(id)).nailed = row == 0;
    }
  sheet::join_neighbors(sim, n, k, k, d);
  return sim;
}

// 1 m x 1 m, flat in the plane of the screen, with gravity perpendicular to it, 0.2 kg, k = 1000 N/m and 500 N/m on diagonals, at rest and
// nailed at two corners.
inline TestSim cloth(int n) {
  TestSim sim;
  sim.system.gravity = {0.0, 0.0, -9.81};
  const double a = 1.0 / (n - 1);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const PointId id = sim.add({a * column, -a * row, 0.0}, 0.2 / (n * n));
      sim.system.point(sim.system.index_of(id)).nailed = row == 0 && (column == 0 || column == n - 1);
    }
  sheet::join_neighbors(sim, n, 1000.0, 500.0, 0.0);
  return sim;
}

// RMS distance of the points between two states of the same scene [m].
inline double distance(const State& first, const State& second) {
  double sum = 0.0;
  for (std::size_t i = 0; i < first.position.size(); ++i) {
    const Vec3 difference = first.position[i] - second.position[i];
    sum += difference.x * difference.x + difference.y * difference.y + difference.z * difference.z;
  }
  return std::sqrt(sum / static_cast<double>(first.position.size()));
}

}  // namespace hooke
