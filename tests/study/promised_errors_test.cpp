// The documented errors of methods on the benchmark scenes: RMS distance of the points to the converged motion, which SUNDIALS confirms
// (oracle_test).
#include <gtest/gtest.h>

#include <cmath>

#include "formats/scene_file.h"
#include "study/analytic_scenes.h"
#include "support/nets.h"

namespace hooke {
namespace {

TestSim shipped(const char* id) {
  const Scene scene = load_scene(find_scene(id)).scene;
  return {scene.system, scene.state};
}

TestSim fine_net(double stiffness) {
  const InitialState start = make_net(64, stiffness, 0.0);
  return {start.system, start.state};
}

State after(const TestSim& start, const char* method, double seconds, double hertz) {
  TestSim sim = start;
  sim.run(*find_integrator(method), seconds, static_cast<int>(std::lround(seconds * hertz)));
  return sim.state;
}

// In these scenes tolerances of 1e-10 m and 1e-13 m give the same steps, because stability is more restrictive.
State converged(const TestSim& start, double seconds) {
  TestSim sim = start;
  sim.run(*find_integrator("dop853"), seconds, 1, 1e-10);
  return sim.state;
}

// Each bound is the published figure plus rounding.

TEST(PromisedErrors, OfVerletAndRungeKuttaOnTheDrum) {
  const TestSim drum = shipped("drum_32");
  const State exact = converged(drum, 1.0);
  EXPECT_LT(distance(after(drum, "velocity_verlet", 1.0, 3200.0), exact), 1.65e-5);
  EXPECT_LT(distance(after(drum, "runge_kutta4", 1.0, 12800.0), exact), 3.05e-10);
}

TEST(PromisedErrors, OfRungeKuttaOnTheRope) {
  const TestSim rope = shipped("rope_64");
  EXPECT_LT(distance(after(rope, "runge_kutta4", 0.5, 12800.0), converged(rope, 0.5)), 3.75e-9);
}

TEST(PromisedErrors, OfRungeKuttaOnTheCloth) {
  const TestSim cloth = shipped("cloth_32");
  EXPECT_LT(distance(after(cloth, "runge_kutta4", 0.5, 6400.0), converged(cloth, 0.5)), 5.65e-8);
}

// TR-BDF2 for half a second at one step per frame, and its cost.
struct OneStepAFrame {
  State state;
  long unconverged_solves = 0, max_factorizations = 0;

  explicit OneStepAFrame(const TestSim& start) : state(start.state) {
    Plan plan = make_plan(start.system);
    Frame frame;
    for (int i = 0; i < 30; ++i) {
      frame.begin(plan, start.system, {.integrator = find_integrator("tr_bdf2"), .frame_rate = 60.0, .substeps = 1}, state);
      while (!frame.done()) frame.substep(plan);
      frame.end(plan, state);
      unconverged_solves += frame.motion().counts.unconverged_solves;
      max_factorizations = std::max(max_factorizations, frame.factorizations());
    }
  }
};

TEST(PromisedErrors, OfTrBdf2OnAFineNetWithAtMostThreeFactorizationsPerStep) {
  const TestSim net = fine_net(1e4);
  const OneStepAFrame run(net);
  EXPECT_LT(distance(run.state, converged(net, 0.5)), 1.25e-5);
  EXPECT_EQ(run.unconverged_solves, 0);
  EXPECT_LE(run.max_factorizations, 3);
}

// converged: the error of Verlet with 3.4 times the steps of its limit is 4e-10 m
TEST(PromisedErrors, OfTrBdf2AndXpbdOnAStiffFineNet) {
  const TestSim net = fine_net(1e6);
  const State exact = after(net, "velocity_verlet", 0.5, 96000.0);
  const OneStepAFrame run(net);
  EXPECT_LT(distance(run.state, exact), 1.25e-5);
  EXPECT_EQ(run.unconverged_solves, 0);
  EXPECT_LT(distance(after(net, "xpbd", 0.5, 60.0 * 40.0), exact), 4.5e-3);
}

}  // namespace
}  // namespace hooke
