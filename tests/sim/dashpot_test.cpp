// The dashpots of velocity Verlet, each solved exactly: correct order at any strength.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "sim/methods/rows.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/nets.h"

namespace hooke {
namespace {

// w <- w e^(-d t (1/m1 + 1/m2)) for any step size; the rest of the motion is unaffected
TEST(Dashpot, AloneDecaysExactly) {
  for (const double d : {0.1, 10.0, 1e6}) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId first = sim.add({0.0, 0.0, 0.0}, 0.5, {1.0, 0.0, 2.0}), second = sim.add({100.0, 0.0, 0.0}, 2.0, {-1.0, 0.0, 2.0});
    sim.join(first, second, 0.0, 1.0, d);
    sim.run(velocity_verlet, 0.5, 3);
    const double w = 2.0 * std::exp(-d * 0.5 * 2.5), center = -0.6;
    EXPECT_NEAR(sim.velocity(first).x, center + w * 0.8, 1e-14) << "d = " << d;
    EXPECT_NEAR(sim.velocity(second).x, center - w * 0.2, 1e-14) << "d = " << d;
    EXPECT_EQ(sim.velocity(first).z, 2.0);
  }
}

TEST(Dashpot, ToANailMovesOnlyTheFreePoint) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId point = sim.add({1.0, 0.0, 0.0}, 0.5, {1.0, 0.0, 0.0}), nail = sim.nail(Vec3(0.0));
  const Vec3 place = sim.position(nail);
  sim.join(nail, point, 0.0, 1.0, 1e9);
  sim.run(velocity_verlet, 1e-3, 1);
  EXPECT_EQ(sim.velocity(point), Vec3(0.0));
  EXPECT_EQ(sim.position(point), Vec3(1.0, 0.0, 0.0));
  EXPECT_EQ(sim.position(nail), place);
}

TEST(Dashpot, OfModerateStrengthKeepsVerletSecondOrder) {
  for (const double d : {0.1, 0.9}) {
    const auto after = [&](int steps) {
      TestSim sim = net(16, 1e4, d);
      sim.run(velocity_verlet, 0.1, steps);
      return sim.state;
    };
    const State coarse = after(1000), middle = after(2000), fine = after(4000);
    EXPECT_NEAR(std::log2(distance(coarse, middle) / distance(middle, fine)), 2.0, 0.15) << "d = " << d;
  }
}

// at the stability limit of the undamped step; d h / m = 85 and 5e4
TEST(Dashpot, OfAnyStrengthIsStable) {
  for (const double d : {1e3, 5.9e5}) {
    TestSim sim = net(16, 1e4, d);
    const double start = compute_energy(sim.system, sim.state).total();
    double min = start;
    for (int frame = 0; frame < 15; ++frame) {
      sim.run(velocity_verlet, 1.0 / 60.0, 50);
      const double energy = compute_energy(sim.system, sim.state).total();
      EXPECT_LT(energy, min + 1e-9 * std::abs(start)) << "d = " << d << ", frame " << frame;
      min = energy;
    }
    EXPECT_TRUE(is_finite(sim.state));
  }
}

// even the slow drift of such a heavily damped net is accurate at that step, to 1e-5 of its size
TEST(Dashpot, OfGreatStrengthDriftsAccurately) {
  TestSim coarse = net(16, 1e4, 1e3), fine = coarse;
  const State start = coarse.state;
  coarse.run(velocity_verlet, 0.25, 750);
  fine.run(velocity_verlet, 0.25, 6000);
  EXPECT_LT(distance(coarse.state, fine.state), 1e-5);
  EXPECT_GT(distance(fine.state, start), 1e-3);
}

TEST(Dashpot, SwitchedOffDoesNothing) {
  TestSim damped = net(6, 1e2, 0.9), plain = net(6, 1e2, 0.0);
  damped.system.switches.dashpots = false;
  damped.run(velocity_verlet, 0.5, 100);
  plain.run(velocity_verlet, 0.5, 100);
  EXPECT_EQ(damped.state, plain.state);
}

}  // namespace
}  // namespace hooke
