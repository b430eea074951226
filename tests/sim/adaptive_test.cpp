// Methods that choose their own steps: they end or say why not, and their tolerance controls impacts too.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/forces/energy/energy.h"
#include "sim/methods/rows.h"
#include "sim/step/step.h"
#include "support/convergence.h"
#include "support/fall.h"
#include "support/folds.h"
#include "support/nets.h"

namespace hooke {
namespace {

// A mass on a spring and a dashpot so strong that a frame takes millions of steps.
TestSim overdamped(double damping) {
  TestSim sim;
  sim.join(sim.add({1.1, 0.0, 0.0}), sim.nail(Vec3(0.0)), 100.0, 1.0, damping);
  return sim;
}

// also where each of many substeps takes few enough
TEST(AdaptiveStep, GivesUpWhenAFrameTakesTooManyForceEvaluations) {
  for (const auto& [damping, substeps] : {std::pair{1e11, 1}, std::pair{1e9, 100}}) {
    TestSim sim = overdamped(damping);
    Plan plan = make_plan(sim.system);
    Frame frame;
    frame.begin(plan, sim.system, {.integrator = &dop853, .substeps = substeps}, sim.state);
    while (!frame.done()) frame.substep(plan);
    EXPECT_EQ(frame.failure(), StepFailure::TooMany);
    EXPECT_NEAR(static_cast<double>(frame.force_evaluations()), static_cast<double>(max_adaptive_evaluations),
                1e-3 * max_adaptive_evaluations);
    EXPECT_LT(frame.substeps_done(), substeps);
  }
}

TEST(AdaptiveStep, GivesUpAtALowerLimitToo) {
  constexpr long limit = 5'000;
  TestSim sim = overdamped(1e9);
  Plan plan = make_plan(sim.system);
  Frame frame;
  frame.limit_evaluations(limit);
  frame.begin(plan, sim.system, {.integrator = &dop853, .substeps = 1}, sim.state);
  while (!frame.done()) frame.substep(plan);
  EXPECT_EQ(frame.failure(), StepFailure::TooMany);
  EXPECT_NEAR(static_cast<double>(frame.force_evaluations()), static_cast<double>(limit), 100.0);
}

// Contact of faces costs far more than the forces, and is part of every step.
TEST(AdaptiveStep, GivesUpWhenAFrameTakesTooManyStepsWithContactOfFaces) {
  TestSim sim;
  folds::add_sheet(
      sim, 2, [](double x, double z) { return Vec3(x, 0.0, z); }, folds::at_rest);
  folds::touch(sim);
  Plan plan = make_plan(sim.system);
  const auto failure_with = [&](int substeps) {
    Frame frame;
    frame.begin(plan, sim.system, {.integrator = &dop853, .substeps = substeps}, sim.state);
    while (!frame.done()) frame.substep(plan);
    return frame.failure();
  };
  EXPECT_EQ(failure_with(static_cast<int>(max_adaptive_surface_steps)), StepFailure::None);
  EXPECT_EQ(failure_with(static_cast<int>(max_adaptive_surface_steps) + 1), StepFailure::TooMany);
}

TEST(AdaptiveStep, IsOneCallEachSoThatAFrameCanBeInterrupted) {
  TestSim sim = overdamped(1e6);
  Plan plan = make_plan(sim.system);
  Frame frame;
  frame.begin(plan, sim.system, {.integrator = &dop853, .substeps = 2}, sim.state);
  long calls = 0, evaluations = 0, most = 0;
  for (; !frame.done(); ++calls) {
    frame.substep(plan);
    most = std::max(most, frame.force_evaluations() - evaluations);
    evaluations = frame.force_evaluations();
  }
  EXPECT_EQ(frame.failure(), StepFailure::None);
  EXPECT_GT(calls, 1000);
  EXPECT_LT(most, 1000);
}

TEST(AdaptiveStep, FindsNoStepWhereForcesAreNotFinite) {
  TestSim sim = overdamped(0.0);
  sim.state.velocity[0].x = 1e300;
  sim.system.spring(0)->damping = 1e300;
  Plan plan = make_plan(sim.system);
  Frame frame;
  frame.begin(plan, sim.system, {.integrator = &dop853, .substeps = 1}, sim.state);
  for (long calls = 0; !frame.done() && calls < 1000; ++calls) frame.substep(plan);
  EXPECT_EQ(frame.failure(), StepFailure::TooShort);
}

TEST(AdaptiveStep, IgnoresAMemoryThatIsNoStep) {
  const auto run = [](const MethodMemory& memory) {
    TestSim sim = overdamped(1.0);
    sim.state.memory = memory;
    sim.run(dop853, frame_time, 1, 1e-8);
    return sim.state.position;
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expected = run({});
  for (const MethodMemory& memory : {MethodMemory{nan, nan}, {-1.0, 1.0}, {1e-3, nan}, {0.0, 1.0}}) EXPECT_EQ(run(memory), expected);
}

// A mass that bounces on a floor, hanging from a spring that swings and pulls it aside.
TestSim bouncing(double restitution, double friction) {
  TestSim sim;
  const PointId mass = sim.add({0.0, 0.4, 0.0}, 0.5, {0.7, 0.0, 0.0});
  sim.join(mass, sim.nail({0.3, 1.2, 0.0}), 40.0, 0.9);
  const PointId second = sim.add({0.4, 0.6, 0.1}, 0.3, {0.0, 0.5, 0.0});
  sim.join(mass, second, 60.0, 0.4);
  sim.system.colliders = {{.shape = Plane{}, .restitution = restitution, .friction = friction}};
  return sim;
}

TEST(AdaptiveStep, EndsWhenTheFirstStepTouches) {
  for (const double step : {0.0, 1e-3}) {
    TestSim sim = bouncing(0.0, 0.5);
    sim.state.position[0].y = 0.0;
    sim.state.velocity[0] = {0.7, -3.0, 0.0};
    sim.state.memory.step = step;
    Plan plan = make_plan(sim.system);
    Frame frame;
    frame.begin(plan, sim.system, {.integrator = &dop853, .substeps = 1, .tolerance = 1e-8}, sim.state);
    while (!frame.done()) frame.substep(plan);
    EXPECT_EQ(frame.failure(), StepFailure::None);
    EXPECT_LT(frame.force_evaluations(), 20'000);
  }
}

// against another method at a fine step, as far as that one has converged itself
TEST(AdaptiveStep, KeepsItsToleranceThroughImpacts) {
  for (const auto& [restitution, friction] : {std::pair(1.0, 0.0), {0.6, 0.0}, {0.5, 0.4}, {0.0, 0.3}}) {
    TestSim reference = bouncing(restitution, friction), coarser = reference;
    reference.run(runge_kutta4, 1.0, 1 << 17);
    coarser.run(runge_kutta4, 1.0, 1 << 16);
    const double uncertainty = 2.0 * distance(reference.state, coarser.state);
    double before = 1.0;
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      TestSim sim = bouncing(restitution, friction);
      sim.run(dop853, 1.0, 1, tolerance);
      const double error = distance(sim.state, reference.state);
      EXPECT_LT(error, 1e3 * tolerance + uncertainty) << "restitution " << restitution << ", friction " << friction << ", " << tolerance;
      EXPECT_LT(error, 0.3 * before + uncertainty) << "restitution " << restitution << ", friction " << friction << ", " << tolerance;
      before = error;
    }
  }
}

// the number of substeps only determines where steps must end: it changes the steps, but not the accuracy
TEST(AdaptiveStep, DoesNotDependOnTheSubstepsThroughImpacts) {
  TestSim coarse = bouncing(0.6, 0.2), fine = bouncing(0.6, 0.2);
  coarse.run(dop853, 1.0, 1, 1e-9);
  fine.run(dop853, 1.0, 600, 1e-9);
  EXPECT_LT(distance(coarse.state, fine.state), 1e-6);
}

// Until the impact, the step and its parts follow the same parabola; after it, the spring acts.
TEST(AdaptiveStep, KeepsItsToleranceWhereAnImpactEndsAFreeFall) {
  constexpr double duration = 0.25, gravity = 9.81;
  for (const double stiffness : {400.0, 14000.0})
    for (const double part : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const double height = 0.5 * gravity * part * part * duration * duration;
      const auto falling = [&] {
        TestSim sim;
        sim.join(sim.add({0.0, height, 0.0}), sim.add({0.0, height + 0.5, 0.0}), stiffness, 0.5);
        sim.system.colliders = {{.shape = Plane{}, .restitution = 0.5}};
        return sim;
      };
      TestSim reference = falling(), coarser = falling(), sim = falling();
      reference.run(runge_kutta4, duration, 1 << 15);
      coarser.run(runge_kutta4, duration, 1 << 14);
      sim.run(dop853, duration, 1, 1e-8);
      EXPECT_LT(distance(sim.state, reference.state), 1e-6 + 2.0 * distance(reference.state, coarser.state))
          << stiffness << " N/m, impact at " << part << " of the step";
    }
}

}  // namespace
}  // namespace hooke
