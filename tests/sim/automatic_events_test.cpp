// The method `auto` estimates the error anew as soon as the motion changes, and keeps to its budget.
#include <gtest/gtest.h>

#include "sim/model/hash.h"
#include "support/accuracy_scenes.h"
#include "support/automatic_runs.h"

namespace hooke {
namespace {

// A run that is calm: the next estimate is frames away.
class CalmRun {
 public:
  explicit CalmRun(TestSim sim) : sim_(std::move(sim)), plan_(make_plan(sim_.system)) {
    for (int i = 0; i < 200 && !is_calm(); ++i) step();
    EXPECT_TRUE(is_calm());
  }
  void step() { sim_.state = next_frame(plan_, frame_, sim_.system, automatic(1e-3), sim_.state); }
  bool is_calm() const { return sim_.state.memory.choice && choice().until_estimate > 8; }
  // Whether the error of the last frame was estimated before it, and will be soon again.
  bool has_restarted() const { return choice().until_estimate == choice().period && choice().period <= 3; }
  const MethodChoice& choice() const { return *sim_.state.memory.choice; }
  TestSim& sim() { return sim_; }

 private:
  TestSim sim_;
  Plan plan_;
  Frame frame_;
};

TestSim swinging_net() { return net(8, 1e2, 0.0); }

TEST(AutomaticEvents, AnEditIsOne) {
  CalmRun run(swinging_net());
  run.step();
  EXPECT_FALSE(run.has_restarted());
  run.sim().system.point(63).mass *= 0.5;
  run.step();
  EXPECT_TRUE(run.has_restarted());
}

TEST(AutomaticEvents, ASliderThatJumpsIsOneAndTheStepIsStableAtOnce) {
  CalmRun run(swinging_net());
  for (Index i = 0; i < run.sim().system.spring_count(); ++i) run.sim().system.spring(i)->stiffness = 1e5;
  run.step();
  EXPECT_TRUE(run.choice().until_estimate <= 12);
  EXPECT_GE(run.choice().substeps, run.choice().min_substeps);
  const Plan plan = make_plan(run.sim().system);
  EXPECT_LE(run.choice().frequency / 60.0 / run.choice().substeps, largest_stable_step(*run.choice().method, plan.spectrum) * (1.0 + 1e-9));
}

TEST(AutomaticEvents, ASuddenMotionOfTheHandIsOne) {
  TestSim sim = accuracy_scene::pulled();
  sim.state.hand.target = sim.state.hand.position;
  sim.system.hand_speed = 100.0;
  CalmRun run(sim);
  run.sim().state.hand.target += Vec3(0.0, 0.0, 0.5);
  run.step();
  EXPECT_TRUE(run.has_restarted());
}

TEST(AutomaticEvents, AnImpactIsOneInTheFrameInWhichItHappens) {
  TestSim sim;
  const PointId first = sim.add({0.0, 1.0, 0.0}), second = sim.add({0.1, 1.0, 0.0});
  sim.join(first, second, 100.0, 0.1);
  for (Vec3& v : sim.state.velocity) v = {0.0, -5.0, 0.0};
  sim.system.gravity = Vec3(0.0);
  sim.system.colliders.push_back({.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}, .restitution = 0.3});
  CalmRun run(sim);
  int frames = 0;
  while (run.sim().state.velocity[0].y < 0.0 && ++frames < 100) run.step();
  ASSERT_LT(frames, 100);
  EXPECT_TRUE(run.has_restarted());
}

TEST(AutomaticBudget, IsKeptAndAToleranceThatNeedsMoreIsReportedAsNotMet) {
  TestSim sim = accuracy_scene::rope();
  Plan plan = make_plan(sim.system);
  Frame frame;
  const double budget_ms = 0.01;
  const Settings settings = automatic(1e-9, budget_ms);
  int beyond = 0;
  for (int i = 0; i < 40; ++i) {
    sim.state = next_frame(plan, frame, sim.system, settings, sim.state);
    const MethodChoice& choice = *sim.state.memory.choice;
    EXPECT_LE(choice.cost, 1.25 * budget_ms) << i;
    if (is_tolerance_met(choice, settings)) continue;
    ++beyond;
    EXPECT_NE(describe(choice, settings).find("tolerance not met"), std::string::npos);
    EXPECT_NE(describe(choice, settings).find("within the budget"), std::string::npos);
  }
  EXPECT_GT(beyond, 0);
}

// No method is stable within this budget: the cheapest one is used, and it is said.
TEST(AutomaticBudget, IsExceededRatherThanUnstable) {
  TestSim sim = net(8, 1e6, 0.0);
  Plan plan = make_plan(sim.system);
  Frame frame;
  const Settings settings = automatic(1e-3, 1e-6);
  for (int i = 0; i < 20; ++i) sim.state = next_frame(plan, frame, sim.system, settings, sim.state);
  EXPECT_LT(glm::length(sim.state.position[63]), 10.0);
  EXPECT_NE(describe(*sim.state.memory.choice, settings).find("Nothing that is stable is within the budget"), std::string::npos)
      << describe(*sim.state.memory.choice, settings);
}

TEST(AutomaticBudget, TheSameOneGivesTheSameBits) {
  const auto hash = [](double budget_ms) {
    TestSim sim = accuracy_scene::rope();
    Plan plan = make_plan(sim.system);
    Frame frame;
    for (int i = 0; i < 20; ++i) sim.state = next_frame(plan, frame, sim.system, automatic(1e-9, budget_ms), sim.state);
    return hash_state(sim.state);
  };
  EXPECT_EQ(hash(0.005), hash(0.005));
  EXPECT_NE(hash(0.005), hash(0.0));
}

}  // namespace
}  // namespace hooke
