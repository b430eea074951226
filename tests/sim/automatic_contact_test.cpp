// The method `auto` where things strike each other: it keeps the tolerance or reports that it does not, and its cost is bounded.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

#include "support/accuracy_scenes.h"
#include "support/automatic_runs.h"
#include "support/convergence.h"

namespace hooke {
namespace {

TestSim bouncing_pair() {
  TestSim sim;
  sim.join(sim.add({0.0, 0.5, 0.0}), sim.add({0.3, 0.6, 0.0}), 200.0, 0.3);
  sim.system.colliders.push_back({.shape = Plane{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, .restitution = 0.6, .friction = 0.3});
  return sim;
}

TestSim net_on_ball() {
  TestSim sim;
  std::vector<PointId> ids;
  constexpr int n = 4;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) ids.push_back(sim.add({0.1 * column - 0.16, 0.35, 0.1 * row - 0.14}, 0.02));
  for (int i = 0; i < n * n; ++i) {
    if (i % n + 1 < n) sim.join(ids[i], ids[i + 1], 50.0, 0.1, 0.02);
    if (i + n < n * n) sim.join(ids[i], ids[i + n], 50.0, 0.1, 0.02);
  }
  sim.system.colliders.push_back({.shape = Sphere{{0.0, 0.0, 0.0}, 0.3}, .friction = 0.4});
  return sim;
}

// Balls that fall onto each other in a bin.
TestSim balls_in_bin() {
  TestSim sim;
  sim.system.dimensions = 2;
  for (int i = 0; i < 9; ++i) {
    const int row = i / 3, column = i % 3;
    const PointId id = sim.add({0.11 * column - 0.1 + 0.013 * row, 0.2 + 0.15 * row, 0.0}, 0.1);
    sim.system.point(sim.system.index_of(id)).radius = 0.05;
  }
  sim.system.contact = {.points = true, .restitution = 0.4, .friction = 0.2};
  for (const auto& [point, normal] : {std::pair(Vec3(0.0), Vec3(0.0, 1.0, 0.0)), std::pair(Vec3(-0.2, 0.0, 0.0), Vec3(1.0, 0.0, 0.0)),
                                      std::pair(Vec3(0.2, 0.0, 0.0), Vec3(-1.0, 0.0, 0.0))})
    sim.system.colliders.push_back({.shape = Plane{point, normal}, .restitution = 0.4, .friction = 0.2});
  return sim;
}

// Two balls that meet in flight: nothing but the impact itself shows that it comes.
TestSim head_on() {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  for (const double side : {-1.0, 1.0}) {
    const PointId id = sim.add({side, 0.02 * side, 0.0}, 0.1, {-2.0 * side, 0.0, 0.0});
    sim.system.point(sim.system.index_of(id)).radius = 0.05;
  }
  sim.system.contact = {.points = true, .restitution = 0.8};
  return sim;
}

struct ContactRun {
  int frames = 0, within = 0, silent = 0;  // silent: beyond the tolerance, and reported as within
  double max_trial = 0.0, cost = 0.0;      // [ms], by the model
};

ContactRun run_in_contact(TestSim sim, double tolerance, int frames) {
  const Settings settings = automatic(tolerance), exact{.integrator = find_integrator("blanes_moan4"), .substeps = 200};
  Plan plan = make_plan(sim.system), exact_plan = plan;
  Frame frame, exact_frame;
  ContactRun run;
  for (; run.frames < frames; ++run.frames) {
    const double before = frame.trial_cost();
    const State after = next_frame(plan, frame, sim.system, settings, sim.state);
    const State truth = next_frame(exact_plan, exact_frame, sim.system, exact, sim.state);
    const bool is_within = distance(after, truth) <= tolerance / settings.frame_rate;
    const bool is_reported = !is_tolerance_met(*after.memory.choice, settings);
    run.within += is_within ? 1 : 0;
    run.silent += !is_within && !is_reported ? 1 : 0;
    run.max_trial = std::max(run.max_trial, frame.trial_cost() - before);
    sim.state = after;
  }
  run.cost = frame.trial_cost();
  return run;
}

struct ContactScene {
  const char* name;
  TestSim (*make)();
};

class AutomaticContact : public testing::TestWithParam<ContactScene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, AutomaticContact,
                         testing::Values(ContactScene{"bouncing_pair", bouncing_pair}, ContactScene{"net_on_ball", net_on_ball},
                                         ContactScene{"balls_in_bin", balls_in_bin}, ContactScene{"head_on", head_on}),
                         [](const auto& scene) { return std::string(scene.param.name); });

TEST_P(AutomaticContact, KeepsTheToleranceOrReportsAtABoundedCost) {
  constexpr double max_trial_ms = 30.0;  // by the model, of the trials of a frame
  for (const double tolerance : {1e-2, 1e-3}) {
    const ContactRun run = run_in_contact(GetParam().make(), tolerance, 45);
    if (std::getenv("HOOKE_PRINT") != nullptr)
      std::printf("%-14s %g: %d of %d frames within, %d beyond in silence; trials of a frame up to %.3g ms, in total %.3g ms\n",
                  GetParam().name, tolerance, run.within, run.frames, run.silent, run.max_trial, run.cost);
    EXPECT_LE(run.silent, 0.07 * run.frames) << tolerance;
    EXPECT_LT(run.max_trial, max_trial_ms) << tolerance;
  }
}

// What slides off a block is in free flight from within a frame on. On the block, a method of first order is exact.
TEST(AutomaticEdge, KeepsTheToleranceOfAPointThatSlidesOff) {
  constexpr double g = 9.81, length = 0.7, radius = 0.02;
  for (const double speed : {1.0, 1.4, 1.5, 1.9, 2.7})
    for (const double friction : {0.0, 0.05})
      for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
        TestSim sim;
        sim.system.colliders = {
            {.shape = Box{.min = {-5.0, -1.0, -1.0}, .max = {0.0, 0.0, 1.0}}, .restitution = 0.5, .friction = friction}};
        sim.add({-length, radius, 0.0}, 1.0, {speed, 0.0, 0.0});
        sim.system.point(0).radius = radius;
        const double left = std::sqrt(speed * speed - 2.0 * friction * g * length);
        const double slide = friction > 0.0 ? (speed - left) / (friction * g) : length / speed;
        Plan plan = make_plan(sim.system);
        Frame frame;
        constexpr double seconds = 1.5;
        for (int i = 0; i < 90; ++i) sim.state = next_frame(plan, frame, sim.system, automatic(tolerance), sim.state);
        const Vec3 end(left * (seconds - slide), radius - 0.5 * g * (seconds - slide) * (seconds - slide), 0.0);
        EXPECT_LT(glm::distance(sim.state.position[0], end), tolerance * seconds) << speed << ' ' << friction << ' ' << tolerance;
      }
}

// A ball that falls on a nailed face and leaves it, from heights at which it touches at different times within a frame. A rebound starts at
// the end of a substep: where two numbers of substeps have an end in common, their difference does not say how late that is.
TEST(AutomaticRebound, KeepsTheToleranceOfABallThatLeavesAFace) {
  constexpr double g = 9.81, restitution = 0.6, touch = 0.06, seconds = 0.4, tolerance = 1e-3;
  for (int i = 0; i < 12; ++i) {
    const double height = 0.17 + 0.006 * i;
    TestSim sim;
    sim.system.gravity = {0.0, -g, 0.0};
    sim.system.contact = {.faces = true, .thickness = 0.01, .restitution = restitution};
    sim.add({0.02, touch + height, 0.0}, 0.2);
    sim.system.point(0).radius = 0.05;
    const PointId left = sim.nail({-0.1, 0.0, -0.1}), right = sim.nail({0.1, 0.0, -0.1});
    sim.system.faces.push_back({{left, right, sim.nail({0.0, 0.0, 0.2})}});
    Plan plan = make_plan(sim.system);
    Frame frame;
    for (int k = 0; k < 24; ++k) sim.state = next_frame(plan, frame, sim.system, automatic(tolerance), sim.state);
    const double t = seconds - std::sqrt(2.0 * height / g), speed = restitution * std::sqrt(2.0 * g * height);
    EXPECT_NEAR(sim.state.position[0].y, touch + speed * t - 0.5 * g * t * t, std::sqrt(4.0) * tolerance * seconds) << height;
  }
}

}  // namespace
}  // namespace hooke
