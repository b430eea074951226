// The benchmark of contact in folds: a sheet that stands on an edge and crumples under its weight.
#pragma once

#include <cmath>
#include <numbers>

#include "support/nets.h"

namespace hooke {

// n x n points, 1 m wide and high, of 0.2 kg; nearly flat, so that it buckles.
inline TestSim upright_sheet(int n, bool touches) {
  TestSim sim;
  sim.system.drag = 0.3;
  const double a = 1.0 / (n - 1);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const PointId id = sim.add({0.002 * std::sin(9.0 * a * j), 0.05 + a * i, a * j}, 0.2 / (n * n));
      sim.system.point(sim.system.index_of(id)).radius = 0.001;
    }
  const auto id = [&](int i, int j) { return sim.system.points()[i * n + j].id; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (j + 1 < n) sim.join(id(i, j), id(i, j + 1), 300.0, a, 0.002);
      if (i + 1 < n) sim.join(id(i, j), id(i + 1, j), 300.0, a, 0.002);
      if (i + 1 == n || j + 1 == n) continue;
      sim.join(id(i, j), id(i + 1, j + 1), 150.0, std::numbers::sqrt2 * a, 0.002);
      sim.join(id(i, j + 1), id(i + 1, j), 150.0, std::numbers::sqrt2 * a, 0.002);
      sim.system.faces.push_back({{id(i, j), id(i, j + 1), id(i + 1, j)}});
      sim.system.faces.push_back({{id(i + 1, j), id(i, j + 1), id(i + 1, j + 1)}});
    }
  sim.system.colliders = {{.shape = Plane{}, .friction = 0.4}};
  if (touches) sim.system.contact = {.faces = true, .thickness = 0.004, .friction = 0.3};
  return sim;
}

}  // namespace hooke
