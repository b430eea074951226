// The same scene with its points and springs listed in another order; they keep their ids.
#pragma once

#include <numeric>

#include "support/random_scene.h"

namespace hooke {

inline std::vector<std::size_t> shuffled_indices(std::size_t count, Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<Index>(i)))]);
  return order;
}

inline TestSim shuffled(const TestSim& sim, std::uint64_t seed = 1) {
  Random random(seed);
  TestSim result = sim;
  std::vector<Point> points;
  std::vector<Spring> springs;
  for (const std::size_t i : shuffled_indices(sim.system.points().size(), random)) {
    result.state.position[points.size()] = sim.state.position[i];
    result.state.velocity[points.size()] = sim.state.velocity[i];
    points.push_back(sim.system.points()[i]);
  }
  for (const std::size_t s : shuffled_indices(sim.system.springs().size(), random)) springs.push_back(sim.system.springs()[s]);
  result.system.set_points(std::move(points));
  result.system.set_springs(springs);
  return result;
}

}  // namespace hooke
