// Sheets that fall into folds, fly through each other and are pulled through themselves: scenes for contact between faces.
#pragma once

#include <cmath>

#include "support/nets.h"

namespace hooke {

namespace folds {

// Adds n x n points with faces and the springs of a cloth of 1 m and 0.2 kg, at the place and velocity of each point on the flat sheet.
template <class Place, class Velocity>
void add_sheet(TestSim& sim, int n, const Place& place, const Velocity& velocity) {
  const double a = 1.0 / (n - 1);
  const Index first = sim.system.point_count();
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) sim.add(place(a * column, a * row), 0.2 / (n * n), velocity(a * column, a * row));
  const auto at = [&](int row, int column) { return first + sheet::at(n, row, column); };
  const auto id = [&](int row, int column) { return sim.system.points()[at(row, column)].id; };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      if (column + 1 < n) sheet::join(sim, at(row, column), at(row, column + 1), 300.0, 0.0, a);
      if (row + 1 < n) sheet::join(sim, at(row, column), at(row + 1, column), 300.0, 0.0, a);
      if (row + 1 == n || column + 1 == n) continue;
      sheet::join(sim, at(row, column), at(row + 1, column + 1), 150.0, 0.0, std::numbers::sqrt2 * a);
      sheet::join(sim, at(row, column + 1), at(row + 1, column), 150.0, 0.0, std::numbers::sqrt2 * a);
      sim.system.faces.push_back({{id(row, column), id(row + 1, column), id(row, column + 1)}});
      sim.system.faces.push_back({{id(row, column + 1), id(row + 1, column), id(row + 1, column + 1)}});
    }
}

inline Vec3 at_rest(double, double) { return Vec3(0.0); }

// Contact of faces at 4 mm with friction.
inline void touch(TestSim& sim, double friction = 0.3) { sim.system.contact = {.faces = true, .thickness = 0.004, .friction = friction}; }

}  // namespace folds

// A hanging sheet, slightly wavy, is dropped on its lower edge: it folds onto itself on the floor.
inline TestSim dropped_sheet(int n) {
  TestSim sim;
  folds::add_sheet(
      sim, n, [](double u, double v) { return Vec3(u - 0.5, 1.02 - v, 0.05 * std::sin(9.0 * v) + 0.02 * std::sin(7.0 * u + 5.0 * v)); },
      folds::at_rest);
  sim.system.colliders = {{.shape = Plane{}, .friction = 0.3}};
  return sim;
}

// Two sheets, one across the other, fly at each other with 20 m/s, in free space.
inline TestSim colliding_sheets(int n) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  folds::add_sheet(
      sim, n, [](double u, double v) { return Vec3(u - 0.5, v - 0.5, -0.1); }, [](double, double) { return Vec3(0.0, 0.0, 10.0); });
  folds::add_sheet(
      sim, n,
      [](double u, double v) { return Vec3(0.8 * (u - 0.5) + 0.6 * (v - 0.5) + 0.1, 0.8 * (v - 0.5) - 0.6 * (u - 0.5), 0.1 + 0.6 * u); },
      [](double, double) { return Vec3(0.0, 0.0, -10.0); });
  return sim;
}

// A sheet hangs on its upper edge, bent into a sleeve; a hand pulls a lower corner through it at this speed [m/s].
inline TestSim pulled_sheet(int n, double speed) {
  TestSim sim;
  folds::add_sheet(
      sim, n,
      [](double u, double v) {
        const double angle = 5.5 * (u - 0.5);
        return Vec3(std::sin(angle) / 5.5, -v, std::cos(angle) / 5.5);
      },
      folds::at_rest);
  for (int column = 0; column < n; ++column) sim.system.point(column).nailed = true;
  const PointId corner = sim.system.points()[n * (n - 1)].id;
  sim.system.scripted_hand = ScriptedHand{.point = corner,
                                          .from = sim.position(corner),
                                          .center = {sim.position(corner).x, -0.8, 0.0},
                                          .axis = {1.0, 0.0, 0.0},
                                          .speed = speed,
                                          .begin = 0.0,
                                          .seconds = 1.0};
  return sim;
}

}  // namespace hooke
