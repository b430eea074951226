// Springs that vibrate while their ends slide on a plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/energy.h"
#include "sim/integrators/rows.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// 3 to 7 points that lie on a plane, with springs of one stiffness.
TestSim lying_net(std::uint64_t seed, double restitution, double friction) {
  Random random(seed * 77 + 5);
  TestSim sim;
  const Index points = 3 + random.below(5);
  for (Index i = 0; i < points; ++i) {
    const double x = random.uniform(-0.5, 0.5), z = random.uniform(-0.5, 0.5);
    const double u = random.uniform(-2.0, 2.0), w = random.uniform(-2.0, 2.0);
    sim.add({x, 0.0, z}, random.uniform(0.1, 1.0), {u, 0.0, w});
  }
  const double stiffness = std::pow(10.0, random.uniform(1.0, 4.0));
  for (Index s = 0; s < points + 2; ++s) {
    const Index i = random.below(points), j = (i + 1 + random.below(points - 1)) % points;
    const double length = glm::distance(sim.state.position[i], sim.state.position[j]);
    sim.join(sim.system.points()[i].id, sim.system.points()[j].id, stiffness, length * random.uniform(0.7, 1.3));
  }
  sim.system.colliders = {{.shape = Plane{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, .restitution = restitution, .friction = friction}};
  return sim;
}

// In Euler methods, vibrations grew without bounds where points turned around and slid under friction.
TEST(VibrationOnAPlane, GainsNoEnergyFromContact) {
  for (const char* method : {"symplectic_euler", "velocity_verlet", "xpbd"})
    for (const double friction : {0.0, 0.1, 0.6})
      for (std::uint64_t seed = 0; seed < 60; ++seed) {
        TestSim sim = lying_net(seed, seed % 2 == 0 ? 0.0 : 0.5, friction);
        const int substeps = std::max(1, static_cast<int>(std::ceil(bound_spectrum(sim.system).omega / 0.4 / 60.0)));
        const Energy start = compute_energy(sim.system, sim.state);
        for (int frame = 0; frame < 300; ++frame) {
          sim.run(*find_integrator(method), 1.0 / 60.0, substeps);
          ASSERT_LT(compute_energy(sim.system, sim.state).total(), start.total() + 0.5 * (start.kinetic + start.elastic))
              << method << ", friction " << friction << ", scene " << seed << ", frame " << frame;
        }
      }
}

// Without friction, a spring that lies on the plane vibrates as it does in space.
TEST(VibrationOnAPlane, WithoutFrictionIsThatInSpace) {
  for (const char* method : {"symplectic_euler", "velocity_verlet", "xpbd", "implicit_euler"}) {
    TestSim lying, flying;
    for (TestSim* sim : {&lying, &flying}) {
      sim->join(sim->add({0.0, 0.0, 0.0}, 0.2, {0.3, 0.0, 0.0}), sim->add({1.0, 0.0, 0.0}, 0.5, {-0.2, 0.0, 0.0}), 400.0, 0.8);
      for (int frame = 0; frame < 60; ++frame) {
        if (sim == &flying) sim->system.gravity = Vec3(0.0);
        if (sim == &lying) sim->system.colliders = {{.shape = Plane{}}};
        sim->run(*find_integrator(method), 1.0 / 60.0, 4);
      }
    }
    for (const std::size_t i : {0, 1}) {
      EXPECT_NEAR(lying.state.position[i].x, flying.state.position[i].x, 1e-10) << method;
      EXPECT_NEAR(lying.state.velocity[i].x, flying.state.velocity[i].x, 1e-9) << method;
    }
  }
}

}  // namespace
}  // namespace hooke
