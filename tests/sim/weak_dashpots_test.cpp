// Velocity Verlet with weak dashpots among the forces: order, flights, momentum, energy, and where it sweeps over them instead.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "sim/methods/rows.h"
#include "support/convergence.h"
#include "support/nets.h"
#include "support/next_frame.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr double frame_rate = 60.0;

// Runs frames of 1/60 s; returns the number of sweeps over the dashpots.
long run(TestSim& sim, int frames, int substeps) {
  Plan plan = make_plan(sim.system);
  Frame frame;
  long sweeps = 0;
  for (int i = 0; i < frames; ++i) {
    sim.state = next_frame(plan, frame, sim.system, {.integrator = &velocity_verlet, .substeps = substeps}, sim.state);
    sweeps += frame.motion().counts.dashpot_sweeps;
  }
  return sweeps;
}

// The fewest substeps with which the dashpots are forces.
int min_weak_substeps(const TestSim& sim) {
  const Spectrum& spectrum = make_plan(sim.system).spectrum;
  for (int substeps = 1;; ++substeps) {
    const double h = 1.0 / (frame_rate * substeps), h_omega = h * spectrum.omega, h_lambda = h * spectrum.dashpot_rate;
    if (h_lambda <= 0.3 && h_lambda <= 0.25 * h_omega && 0.25 * h_omega * h_omega + h_lambda <= 0.9) return substeps;
  }
}

double error_of(const TestSim& start, int substeps) {
  TestSim sim = start;
  EXPECT_EQ(run(sim, 6, substeps), 0);
  Plan plan = make_plan(start.system);
  Frame frame;
  State truth = start.state;
  for (int i = 0; i < 6; ++i) truth = next_frame(plan, frame, start.system, {.integrator = &dop853, .tolerance = 1e-13}, truth);
  return distance(sim.state, truth);
}

// A net in free flight that vibrates at all frequencies, at the longest step with dashpots among the forces.
TestSim free_net(double damping) {
  TestSim sim = net(17, 500.0, damping);
  sim.system.gravity = {};
  std::uint64_t random = 1;
  for (Index i = 0; i < sim.system.point_count(); ++i) {
    sim.system.point(i).nailed = false;
    for (int c = 0; c < 3; ++c) {
      random = random * 6364136223846793005u + 1442695040888963407u;
      sim.state.velocity[i][c] = 0.2 * (static_cast<double>(random >> 33) / 0x1p30 - 1.0);
    }
  }
  return sim;
}

TEST(WeakDashpots, KeepTheDeclaredOrder) {
  for (const double damping : {0.01, 0.1}) {
    const TestSim sim = net(17, 500.0, damping);
    EXPECT_NEAR(measured_order([&](int substeps) { return error_of(sim, substeps); }, 40), velocity_verlet.order_with.damped, 0.1)
        << damping;
  }
  TestSim air = net(17, 500.0, 0.1);
  air.system.drag = 4.0;
  EXPECT_NEAR(measured_order([&](int substeps) { return error_of(air, substeps); }, 40), 2.0, 0.1);
}

// The error after 1/20 s of `count` steps, with sweeps if the plan says that the dashpots are strong.
double error_after(const TestSim& start, const State& truth, int count, bool with_sweeps) {
  Plan plan = make_plan(start.system);
  if (with_sweeps) plan.spectrum.dashpot_rate = 1e30;
  const double h = 0.05 / count;
  Motion motion;
  Workspace work;
  pack(plan, start.state, motion);
  velocity_verlet.prepare(plan, h, motion, work);
  for (int i = 0; i < count; ++i, motion.time += h) velocity_verlet.step(plan, motion, work, h);
  EXPECT_EQ(motion.counts.dashpot_sweeps > 0, with_sweeps);
  State state = start.state;
  unpack(plan, motion, state);
  return distance(state, truth);
}

// On a net that vibrates at all frequencies, from the longest step with dashpots among the forces on.
TEST(WeakDashpots, AreAsAccurateAsSweeps) {
  for (const double damping : {0.003, 0.01, 0.03, 0.1}) {
    const TestSim start = free_net(damping);
    TestSim exact = start;
    exact.run(dop853, 0.05, 200, 1e-13);
    const int min_count = min_weak_substeps(start) * 3;
    for (const int count : {min_count, 2 * min_count, 8 * min_count}) {
      const double weak = error_after(start, exact.state, count, false), swept = error_after(start, exact.state, count, true);
      if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("d = %g, %d steps: %.3g m, with sweeps %.3g m\n", damping, count, weak, swept);
      EXPECT_LT(weak, 1.02 * swept) << damping << ", " << count << " steps";
    }
  }
}

TEST(WeakDashpots, StepsAtOnceAreThoseOneByOne) {
  for (const TestSim& sim : {net(17, 500.0, 0.1), random_sim(4, 60, 300, 3, 0.5)}) {
    Plan plan = make_plan(sim.system);
    ASSERT_GE(plan.springs, min_springs_of_grids);
    ASSERT_TRUE(plan.has_dashpots());
    const double h = 1.0 / (frame_rate * min_weak_substeps(sim));
    Motion at_once, one_by_one;
    Workspace work;
    pack(plan, sim.state, at_once);
    pack(plan, sim.state, one_by_one);
    velocity_verlet.prepare(plan, h, at_once, work);
    Flight flight;
    velocity_verlet.fly(plan, at_once, work, h, 20, flight);
    for (int i = 0; i < 20; ++i, one_by_one.time += h) velocity_verlet.step(plan, one_by_one, work, h);
    EXPECT_EQ(at_once.dashpot_sweeps, 0);
    EXPECT_EQ(at_once.force_evaluations, one_by_one.force_evaluations);
    for (std::size_t at = 0; at < at_once.x.size(); ++at) {
      EXPECT_NEAR(at_once.x[at], one_by_one.x[at], 1e-12);
      EXPECT_NEAR(at_once.v[at], one_by_one.v[at], 1e-10);
    }
  }
}

TEST(WeakDashpots, ConserveMomentumToRounding) {
  TestSim sim = free_net(0.1);
  const auto momentum = [&] {
    Vec3 sum{0.0};
    for (Index i = 0; i < sim.system.point_count(); ++i) sum += sim.system.points()[i].mass * sim.state.velocity[i];
    return sum;
  };
  const Vec3 before = momentum();
  EXPECT_EQ(run(sim, 30, min_weak_substeps(sim)), 0);
  EXPECT_LT(glm::distance(momentum(), before), 1e-14);
}

TEST(WeakDashpots, TakeEnergyAtTheLongestStep) {
  for (const double damping : {0.001, 0.01, 0.03, 0.1}) {
    TestSim sim = free_net(damping);
    const int substeps = min_weak_substeps(sim);
    // the energy of a mode near the limit oscillates by a part of (h omega)^2 / 4
    const double start = compute_energy(sim.system, sim.state).total();
    double energy = 2.0 * start;
    for (int i = 0; i < 10; ++i) {
      EXPECT_EQ(run(sim, 20, substeps), 0);
      const double now = compute_energy(sim.system, sim.state).total();
      EXPECT_LT(now, energy) << damping << ", after " << 20 * (i + 1) << " frames";
      energy = now;
    }
    EXPECT_LT(energy, 0.9 * start) << damping;
  }
}

TEST(WeakDashpots, AreSweptWhereTheyAreStrongOrTheStepIsNearItsLimit) {
  TestSim strong = net(17, 500.0, 0.3), near_limit = net(17, 500.0, 0.1), small = net(8, 500.0, 0.1);
  const Spectrum spectrum = make_plan(near_limit.system).spectrum;
  EXPECT_GT(run(strong, 1, 400), 0);
  EXPECT_GT(run(near_limit, 1, static_cast<int>(spectrum.omega / (1.95 * frame_rate)) + 1), 0);
  EXPECT_GT(run(small, 1, 100), 0);
}

}  // namespace
}  // namespace hooke
