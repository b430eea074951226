// The method `auto` keeps the tolerance, for little more than the cheapest method would cost, and says what it chose.
#include "sim/control/automatic.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>

#include "sim/control/frame_error.h"
#include "sim/model/hash.h"
#include "support/accuracy_scenes.h"
#include "support/automatic_runs.h"
#include "support/convergence.h"

namespace hooke {
namespace {

// The frame without error in comparison.
const Settings exact_settings{.integrator = find_integrator("dop853"), .substeps = 1, .tolerance = 1e-13};

struct Kept {
  int frames = 0, within = 0;
  double worst = 0.0;  // [1], true error of a frame relative to its share of the tolerance
  std::map<std::string, int> methods;
};

Kept run(TestSim sim, double tolerance, int frames) {
  Plan plan = make_plan(sim.system), exact_plan = plan;
  FrameRunner frame, exact_frame;
  Kept kept;
  const Settings settings = automatic(tolerance);
  const double share = tolerance / settings.frame_rate;
  for (int i = 0; i < frames; ++i) {
    const State after = next_frame(plan, frame, sim.system, settings, sim.state);
    const State truth = next_frame(exact_plan, exact_frame, sim.system, exact_settings, sim.state);
    const double error = distance(after, truth);
    kept.worst = std::max(kept.worst, error / share);
    ++kept.frames;
    kept.within += error <= share;
    ++kept.methods[std::string(after.memory.choice->method->id) + ":" + std::to_string(after.memory.choice->substeps)];
    sim.state = after;
  }
  return kept;
}

void print(const char* name, double tolerance, const Kept& kept) {
  if (std::getenv("HOOKE_PRINT") == nullptr) return;
  std::printf("%-12s %g: %d of %d, worst %.2g;", name, tolerance, kept.within, kept.frames, kept.worst);
  for (const auto& [method, count] : kept.methods) std::printf(" %s x%d", method.c_str(), count);
  std::printf("\n");
}

class AutomaticTolerance : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Tolerances, AutomaticTolerance, testing::Values(1e-2, 1e-4, 1e-6, 1e-8));

TEST_P(AutomaticTolerance, IsKeptInNineteenOfTwentyFrames) {
  int frames = 0, within = 0;
  for (const AccuracyScene& row : accuracy_scenes()) {
    if (row.has_contact) continue;
    const Kept kept = run(row.make(), GetParam(), 40);
    print(std::string(row.name).c_str(), GetParam(), kept);
    frames += kept.frames, within += kept.within;
  }
  EXPECT_GE(within, 0.95 * frames);
}

// Nets that nobody chose: random points, springs, masses and dashpots, started far from equilibrium.
TEST(Automatic, KeepsTheToleranceOnRandomNets) {
  int frames = 0, within = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    const auto number = [&](double min, double max) { return min + (max - min) * static_cast<double>(random()) / 4294967295.0; };
    TestSim sim;
    std::vector<PointId> ids;
    for (int i = 0; i < 12; ++i)
      ids.push_back(i == 0 ? sim.nail(Vec3(0.0)) : sim.add({number(-1, 1), number(-1, 1), number(-1, 1)}, std::pow(10.0, number(-2, 1))));
    for (std::size_t i = 1; i < ids.size(); ++i)
      for (int j = 0; j < 2; ++j)
        if (const PointId other = ids[random() % i]; other != ids[i])
          sim.join(ids[i], other, std::pow(10.0, number(0, 4)), number(0.2, 1.5), seed % 2 == 0 ? number(0, 2) : 0.0);
    const double tolerance = std::pow(10.0, -2.0 - static_cast<double>(seed % 4));
    const Kept kept = run(sim, tolerance, 20);
    print(("random " + std::to_string(seed)).c_str(), tolerance, kept);
    frames += kept.frames, within += kept.within;
  }
  EXPECT_GE(within, 0.95 * frames);
}

// The same bits from the same start: nothing depends on the clock.
TEST(Automatic, TheSameSceneGivesTheSameBits) {
  const auto hash = [] {
    TestSim sim = accuracy_scene::contact();
    Plan plan = make_plan(sim.system);
    FrameRunner frame;
    for (int i = 0; i < 30; ++i) sim.state = next_frame(plan, frame, sim.system, automatic(1e-3), sim.state);
    return hash_state(sim.state);
  };
  EXPECT_EQ(hash(), hash());
}

// A run is continued from a state alone.
TEST(Automatic, WhatItRemembersIsPartOfTheState) {
  TestSim sim = accuracy_scene::held();
  Plan plan = make_plan(sim.system);
  FrameRunner frame;
  State half;
  for (int i = 0; i < 40; ++i) {
    if (i == 20) half = sim.state;
    sim.state = next_frame(plan, frame, sim.system, automatic(1e-4), sim.state);
  }
  FrameRunner another;
  for (int i = 20; i < 40; ++i) half = next_frame(plan, another, sim.system, automatic(1e-4), half);
  EXPECT_EQ(hash_state(half), hash_state(sim.state));
}

// Nails have no error: they dilute neither that of the free points nor a tolerance.
TEST(Automatic, NailsBesideASceneChangeNeitherChoiceNorError) {
  const auto run_beside = [](int nails) {
    TestSim sim = net(8, 1e3, 0.1);
    for (int i = 0; i < nails; ++i) sim.nail({10.0 + 0.1 * i, 0.0, 0.0});
    Plan plan = make_plan(sim.system);
    FrameRunner frame;
    for (int i = 0; i < 20; ++i) sim.state = next_frame(plan, frame, sim.system, automatic(1e-5), sim.state);
    return sim;
  };
  const TestSim alone = run_beside(0), beside = run_beside(500);
  const MethodChoice &expected = *alone.state.memory.choice, &choice = *beside.state.memory.choice;
  EXPECT_EQ(choice.method, expected.method);
  EXPECT_EQ(choice.substeps, expected.substeps);
  ASSERT_TRUE(choice.error && expected.error);
  EXPECT_NEAR(*choice.error, *expected.error, 1e-6 * *expected.error);
  const Settings fixed{.integrator = &default_integrator(), .substeps = 20};
  const double error = estimate_frame_error(alone.system, fixed, alone.state);
  EXPECT_NEAR(estimate_frame_error(beside.system, fixed, beside.state), error, 1e-6 * error);
}

// A sudden change of stiffness never makes it unstable: a slider that jumps by a factor of 1000 and back.
TEST(Automatic, FollowsASliderThatJumps) {
  TestSim sim = net(8, 1e2, 0.0);
  Plan plan = make_plan(sim.system);
  FrameRunner frame;
  for (int i = 0; i < 40; ++i) {
    std::vector<Spring> springs = sim.system.springs();
    for (Spring& spring : springs) spring.stiffness = i % 20 < 10 ? 1e2 : 1e4;
    if (i % 10 == 0) {
      sim.system.set_springs(springs);
      plan = make_plan(sim.system);
    }
    sim.state = next_frame(plan, frame, sim.system, automatic(1e-3), sim.state);
    const MethodChoice& choice = *sim.state.memory.choice;
    EXPECT_GE(choice.substeps, choice.min_substeps);
    EXPECT_TRUE(is_tolerance_met(choice, automatic(1e-3))) << i << ": " << describe(choice, automatic(1e-3));
    ASSERT_LT(glm::length(sim.state.position[63]), 10.0) << i;
  }
}

TEST(Automatic, SaysWhatItChoseAndWhy) {
  TestSim sim = net(8, 1e4, 0.0);
  Plan plan = make_plan(sim.system);
  FrameRunner frame;
  const Settings settings = automatic(1e-2);
  sim.state = next_frame(plan, frame, sim.system, settings, sim.state);
  const MethodChoice& choice = *sim.state.memory.choice;
  const std::string text = describe(choice, settings);
  EXPECT_NE(text.find(std::to_string(choice.substeps) + " substep"), std::string::npos) << text;
  EXPECT_NE(text.find("error"), std::string::npos) << text;
  MethodChoice hopeless = choice;
  hopeless.error = 1e3;
  EXPECT_NE(describe(hopeless, settings).find("tolerance not met"), std::string::npos);
}

// 1 kg falls by 2 m onto a strut, again and again: in the frames in which it arrives, only the velocity shows what the force got wrong.
TEST(Automatic, KeepsTheToleranceWhereAForceBeginsLateInAFrame) {
  TestSim sim;
  sim.system.gravity = {0.0, -9.81, 0.0};
  const PointId ground = sim.nail(Vec3(0.0)), point = sim.add({0.0, 3.0, 0.0}, 1.0);
  sim.join(ground, point, 1000.0, 1.0);
  std::vector<Spring> springs = sim.system.springs();
  springs[0].law = SpringLaw{.force = SpringForce::Strut};
  sim.system.set_springs(springs);
  const auto height_after = [&](const Settings& settings) {
    Plan plan = make_plan(sim.system);
    FrameRunner frame;
    State state = sim.state;
    for (int i = 0; i < 240; ++i) state = next_frame(plan, frame, sim.system, settings, state);
    return state.position[1].y;
  };
  const double exact = height_after({.integrator = find_integrator("runge_kutta4"), .substeps = 2000});
  for (const double tolerance : {1e-3, 1e-5}) EXPECT_NEAR(height_after(automatic(tolerance)), exact, 4.0 * tolerance) << tolerance;
}

TEST(Automatic, ResolvesAColliderThatOscillates) {
  const auto choice_beside = [](double stiffness, double frequency) {
    TestSim sim = net(8, stiffness, 0.0);
    sim.system.colliders = {{.shape = Plane{.point = {0.0, -50.0, 0.0}}, .path = {.amplitude = {0.0, 0.01, 0.0}, .frequency = frequency}}};
    Plan plan = make_plan(sim.system);
    FrameRunner frame;
    sim.state = next_frame(plan, frame, sim.system, automatic(1e-2), sim.state);
    return *sim.state.memory.choice;
  };
  const auto has = [](const MethodChoice& choice, const char* reason) {
    return describe(choice, automatic(1e-2)).find(reason) != std::string::npos;
  };
  // 16 substeps in each of 4 periods; the net alone needs fewer
  const MethodChoice soft = choice_beside(1e2, 240.0);
  EXPECT_EQ(soft.min_substeps, 64);
  EXPECT_TRUE(has(soft, "resolve what moves")) << describe(soft, automatic(1e-2));
}

TEST(Automatic, ScenesWithoutMotionCostTwoSubsteps) {
  TestSim sim;
  sim.nail(Vec3(0.0));
  Plan plan = make_plan(sim.system);
  FrameRunner frame;
  sim.state = next_frame(plan, frame, sim.system, automatic(1e-3), sim.state);
  EXPECT_LE(sim.state.memory.choice->substeps, 2);
  State empty;
  const System nothing;
  Plan none = make_plan(nothing);
  empty = next_frame(none, frame, nothing, automatic(1e-3), empty);
  EXPECT_TRUE(empty.memory.choice);
}

}  // namespace
}  // namespace hooke
