// Random nets whose springs start closer than their thickness: what separates them supplies energy, and the balance says so.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "support/measured_lab.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

TestSim crowded_net(std::uint64_t seed) {
  Random random(seed);
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const auto vector = [&](double size) {
    const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
    return Vec3(x, y, z);
  };
  const Index n = 6 + random.below(14);
  const double size = random.uniform(0.1, 0.5), stiffness = std::pow(10.0, random.uniform(1.5, 4.0));
  std::vector<PointId> ids;
  for (Index i = 0; i < n; ++i) {
    const Vec3 x = vector(size), v = vector(0.1);
    ids.push_back(sim.add(x, random.uniform(0.02, 0.2), v));
    for (Index links = i == 0 ? 0 : 1 + random.below(2); links > 0; --links) {
      const Index j = random.below(i);
      sim.join(ids[static_cast<std::size_t>(j)], ids[static_cast<std::size_t>(i)], stiffness,
               glm::distance(sim.state.position[static_cast<std::size_t>(j)], x) * random.uniform(0.98, 1.02));
    }
  }
  sim.system.contact = {.springs = true, .thickness = std::pow(10.0, random.uniform(-2.5, -0.7)), .friction = 0.0};
  return sim;
}

TEST(CloseStart, GainsOfSeparationAreInTheEnergyBalance) {
  const bool prints = std::getenv("HOOKE_PRINT") != nullptr;
  const int nets = prints ? 120 : 30;
  int gains = 0, stops = 0;
  for (int seed = 0; seed < nets; ++seed) {
    const TestSim sim = crowded_net(static_cast<std::uint64_t>(seed) * 7919 + 29);
    const double start = compute_energy(sim.system, sim.state).total(), omega = make_plan(sim.system).spectrum.omega;
    // a sixth of the linear limit
    const int substeps = std::max(1, static_cast<int>(std::ceil(omega / 60.0 / 0.33)));
    Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator("velocity_verlet"), .substeps = substeps, .tolerance = {}}),
                           AccuracyMode::Frame);
    bool stopped = false;
    for (int i = 0; i < 30 && !stopped; ++i) stopped = !lab.step();
    stops += stopped ? 1 : 0;
    if (stopped && prints) std::printf("net %d stopped\n", seed);
    if (stopped) continue;
    const double gain = compute_energy(lab.scene().system, lab.scene().state).total() - start;
    if (gain <= 0.05 * start) continue;
    ++gains;
    EXPECT_GE(lab.accuracy().energy.method(), gain * (1.0 - 1e-9)) << seed;
  }
  EXPECT_GT(gains, 0);
  EXPECT_LE(stops, nets / 100);
  if (prints) std::printf("%d of %d nets gained more than 5 %%, %d stopped\n", gains, nets, stops);
}

}  // namespace
}  // namespace hooke
