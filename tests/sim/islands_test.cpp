// Parts of a scene that do not affect each other have their own steps with the method `auto`.
#include "sim/step/automatic/islands.h"
#include "sim/forces/force_terms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/model/hash.h"
#include "sim/step/frame_error.h"
#include "support/automatic_runs.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

constexpr int chain_points = 60;
constexpr double soft = 20.0;  // [N/m]
constexpr double frequency_ratio = 30.0;

// A chain that swings from a nail.
void add_swinging_chain(TestSim& sim, double z, double stiffness, double damping = 0.0) {
  PointId last = sim.nail({0.0, 0.0, z});
  for (int i = 1; i < chain_points; ++i) {
    const PointId next = sim.add({0.1 * i, 0.0, z}, 0.01);
    sim.join(last, next, stiffness, 0.1, damping);
    last = next;
  }
}

TestSim swinging_chain(double z, double stiffness) {
  TestSim sim;
  add_swinging_chain(sim, z, stiffness);
  return sim;
}

constexpr double stiff = soft * frequency_ratio * frequency_ratio;

TestSim soft_and_stiff_chains() {
  TestSim sim = swinging_chain(0.0, soft);
  add_swinging_chain(sim, 1.0, stiff);
  return sim;
}

struct AutomaticRun {
  State state;
  double cost = 0.0;  // [ms], by the model, with that of choosing
};

constexpr int run_frames = 40;
const Settings with_tolerance = automatic(1e-3);

AutomaticRun run_automatically(const TestSim& sim, int frames = run_frames) {
  Plan plan = make_plan(sim.system);
  Frame frame;
  AutomaticRun run{.state = sim.state};
  for (int i = 0; i < frames; ++i) {
    run.state = next_frame(plan, frame, sim.system, with_tolerance, run.state);
    run.cost += frame.cost(plan);
  }
  run.cost += frame.trial_cost();
  return run;
}

TEST(Islands, MoveBitForBitAsIfEachWereAlone) {
  const State both = run_automatically(soft_and_stiff_chains()).state;
  ASSERT_EQ(both.memory.islands.size(), 2u);
  int part = 0;
  for (const TestSim& alone : {swinging_chain(0.0, soft), swinging_chain(1.0, stiff)}) {
    const State own = run_automatically(alone).state;
    for (int i = 0; i < chain_points; ++i) {
      const auto at = static_cast<std::size_t>(part * chain_points + i);
      ASSERT_EQ(both.position[at], own.position[static_cast<std::size_t>(i)]) << i;
      ASSERT_EQ(both.velocity[at], own.velocity[static_cast<std::size_t>(i)]) << i;
    }
    EXPECT_EQ(both.memory.islands[static_cast<std::size_t>(part)], *own.memory.choice);
    ++part;
  }
}

TEST(Islands, CostTheSumOfWhatEachCostsAlone) {
  const double both = run_automatically(soft_and_stiff_chains()).cost;
  const double sum = run_automatically(swinging_chain(0.0, soft)).cost + run_automatically(swinging_chain(1.0, stiff)).cost;
  EXPECT_LT(both, 1.01 * sum);
  EXPECT_GT(both, 0.99 * sum);
}

TEST(Islands, AreEachWithinTheTolerance) {
  const TestSim sim = soft_and_stiff_chains();
  Plan plan = make_plan(sim.system), exact_plan = plan;
  Frame frame, exact_frame;
  const Settings exact{.integrator = find_integrator("dop853"), .substeps = 1, .tolerance = 1e-13};
  const double share = *with_tolerance.tolerance / with_tolerance.frame_rate;
  State state = sim.state;
  for (int i = 0; i < run_frames; ++i) {
    const State after = next_frame(plan, frame, sim.system, with_tolerance, state);
    const State truth = next_frame(exact_plan, exact_frame, sim.system, exact, state);
    for (const std::size_t first : {std::size_t{0}, std::size_t{chain_points}}) {
      double sum = 0.0;
      for (std::size_t p = first; p < first + chain_points; ++p) {
        const Vec3 error = after.position[p] - truth.position[p];
        sum += glm::dot(error, error);
      }
      ASSERT_LE(std::sqrt(sum / chain_points), share) << "frame " << i << ", part at " << first;
    }
    state = after;
  }
}

// What is kept from frame to frame besides the state has no effect, after edits too.
TEST(Islands, AreThoseOfThePresentScene) {
  TestSim sim = soft_and_stiff_chains();
  Plan plan = make_plan(sim.system);
  Frame frame;
  const auto step_as_new = [&] {
    Plan new_plan = make_plan(sim.system);
    Frame new_frame;
    const State next = next_frame(plan, frame, sim.system, with_tolerance, sim.state);
    ASSERT_EQ(hash_state(next), hash_state(next_frame(new_plan, new_frame, sim.system, with_tolerance, sim.state)));
    sim.state = next;
  };
  step_as_new();
  EXPECT_EQ(sim.state.memory.islands.size(), 2u);
  sim.system.colliders.push_back({.shape = Plane{{0.0, -0.2, 0.0}, {0.0, 1.0, 0.0}}});
  for (int i = 0; i < 5; ++i) step_as_new();
  EXPECT_EQ(sim.state.memory.islands.size(), 2u);
  std::get<Plane>(sim.system.colliders[0].shape).point.y = -0.1;
  for (int i = 0; i < 5; ++i) step_as_new();
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->stiffness = soft;
  for (int i = 0; i < 3; ++i) step_as_new();
  EXPECT_TRUE(sim.state.memory.islands.empty());
  sim.system.spring(0)->stiffness = stiff;
  for (int i = 0; i < 3; ++i) step_as_new();
  EXPECT_EQ(sim.state.memory.islands.size(), 2u);
}

// What a collider does to one of them has no effect on the other, and its work and losses are those of both.
TEST(Islands, MayTouchTheSameMovingCollider) {
  const auto with_floor = [](TestSim sim) {
    sim.system.colliders.push_back({.shape = Plane{{0.0, -0.15, 0.0}, {0.0, 1.0, 0.0}}, .friction = 0.3});
    sim.system.colliders[0].path = {.amplitude = {0.0, 0.02, 0.0}, .frequency = 2.0};
    return sim;
  };
  const State both = run_automatically(with_floor(soft_and_stiff_chains())).state;
  const State first = run_automatically(with_floor(swinging_chain(0.0, soft))).state;
  const State second = run_automatically(with_floor(swinging_chain(1.0, stiff))).state;
  ASSERT_EQ(both.memory.islands.size(), 2u);
  for (std::size_t i = 0; i < chain_points; ++i) {
    ASSERT_EQ(both.position[i], first.position[i]) << i;
    ASSERT_EQ(both.position[chain_points + i], second.position[i]) << i;
  }
  EXPECT_NE(first.supply.net_input, 0.0);
  EXPECT_NE(second.supply.net_input, 0.0);
  EXPECT_NEAR(both.supply.net_input, first.supply.net_input + second.supply.net_input, 1e-12);
  // works of opposite signs within a frame cancel in the first
  const double scales = first.supply.scale + second.supply.scale;
  EXPECT_LE(both.supply.scale, scales);
  EXPECT_GT(both.supply.scale, 0.999 * scales);
}

// Many soft parts beside a stiff one: joined by springs without stiffness, all of them need the steps of the stiff one.
TEST(Islands, SaveMostOfTheWorkOfALargeSoftPart) {
  TestSim divided = swinging_chain(0.0, stiff);
  for (int i = 1; i <= 10; ++i) add_swinging_chain(divided, i, soft);
  TestSim whole = divided;
  for (Index i = 1; i <= 10; ++i) whole.join(whole.system.points()[0].id, whole.system.points()[i * chain_points].id, 0.0, 1.0);
  const AutomaticRun of_divided = run_automatically(divided, 20), of_whole = run_automatically(whole, 20);
  EXPECT_EQ(of_divided.state.memory.islands.size(), 2u);
  EXPECT_TRUE(of_whole.state.memory.islands.empty());
  EXPECT_GT(of_whole.cost, 3.0 * of_divided.cost);
}

TEST(Islands, ShareTheBudget) {
  constexpr double budget = 0.03;  // [ms]
  const Settings settings = automatic(1e-9, budget);
  TestSim sim = soft_and_stiff_chains();
  Plan plan = make_plan(sim.system);
  Frame frame;
  for (int i = 0; i < 20; ++i) {
    sim.state = next_frame(plan, frame, sim.system, settings, sim.state);
    ASSERT_EQ(sim.state.memory.islands.size(), 2u);
    ASSERT_LT(frame.cost(plan), 1.25 * budget) << i;
  }
  EXPECT_FALSE(is_tolerance_met(*sim.state.memory.choice, settings));
}

// The frames that were computed to choose count after edits too.
TEST(Islands, CountTheCostOfTrialsSinceTheStart) {
  TestSim sim = soft_and_stiff_chains();
  Plan plan = make_plan(sim.system);
  Frame frame;
  double before = 0.0;
  for (int i = 0; i < 6; ++i) {
    sim.state = next_frame(plan, frame, sim.system, with_tolerance, sim.state);
    EXPECT_GE(frame.trial_cost(), before) << i;
    before = frame.trial_cost();
    sim.system.point(3).mass *= 1.1;
    refresh_values(plan, sim.system);
  }
  EXPECT_GT(before, 0.0);
}

TEST(Islands, FromAFileAreOnesThatCanHaveBeenChosen) {
  const MethodMemory memory = run_automatically(soft_and_stiff_chains(), 2).state.memory;
  EXPECT_TRUE(is_valid(memory));
  MethodMemory too_many = memory, adaptive = memory, without_steps = memory;
  too_many.islands.resize(IslandStepsList::max_size + 1, memory.islands[0]);
  adaptive.islands[0].method = find_integrator("dop853");
  without_steps.islands[1].substeps = 0;
  for (const MethodMemory& each : {too_many, adaptive, without_steps}) EXPECT_FALSE(is_valid(each));
}

TEST(Islands, OfSimilarFrequenciesAreSteppedTogether) {
  TestSim sim = swinging_chain(0.0, soft);
  add_swinging_chain(sim, 1.0, 4.0 * soft);
  EXPECT_TRUE(run_automatically(sim, 1).state.memory.islands.empty());
  // a fast part that is nearly all of the scene leaves nothing to save
  TestSim large = swinging_chain(0.0, soft);
  for (int i = 1; i < 8; ++i) add_swinging_chain(large, i, stiff);
  EXPECT_TRUE(run_automatically(large, 1).state.memory.islands.empty());
}

TEST(Islands, ThatMayAffectEachOtherAreSteppedTogether) {
  TestSim touching = soft_and_stiff_chains();
  touching.system.contact.points = true;
  EXPECT_TRUE(run_automatically(touching, 1).state.memory.islands.empty());
  TestSim breaking = soft_and_stiff_chains();
  breaking.system.break_strain = 0.5;
  EXPECT_TRUE(run_automatically(breaking, 1).state.memory.islands.empty());
  TestSim attracted = soft_and_stiff_chains();
  attracted.system.forces.push_back({&force_terms()[0], true, default_values(force_terms()[0])});
  EXPECT_TRUE(run_automatically(attracted, 1).state.memory.islands.empty());
  TestSim held = soft_and_stiff_chains();
  held.system.grab = Grab{.point = held.system.points()[5].id, .kind = GrabKind::Hold};
  held.state.hand = {.position = held.state.position[5], .target = held.state.position[5]};
  EXPECT_TRUE(run_automatically(held, 1).state.memory.islands.empty());
}

TEST(Islands, OfAFrameAreRepeatedWithHalfTheirSteps) {
  TestSim sim = soft_and_stiff_chains();
  sim.state = run_automatically(sim, 3).state;
  Plan plan = make_plan(sim.system);
  Frame frame, again;
  const State after = next_frame(plan, frame, sim.system, with_tolerance, sim.state);
  const Settings used = settings_used(with_tolerance, after);
  ASSERT_EQ(used.islands.size(), 2u);
  EXPECT_EQ(hash_state(next_frame(plan, again, sim.system, used, sim.state)), hash_state(after));
  const Settings fine = refined(sim.system, used);
  for (std::size_t g = 0; g < 2; ++g) EXPECT_EQ(fine.islands[g].substeps, 2 * used.islands[g].substeps);

  const State truth = next_frame(plan, again, sim.system, {.integrator = find_integrator("dop853"), .tolerance = 1e-13}, sim.state);
  const double error = weighted_distance(after.position, truth.position, 1.0).rms;
  const double estimate = estimate_frame_error(sim.system, with_tolerance, sim.state);
  EXPECT_GT(estimate, 0.5 * error);
  EXPECT_LT(estimate, 2.2 * error);
}

TEST(Islands, AreExplained) {
  const State state = run_automatically(soft_and_stiff_chains(), 2).state;
  const std::string text = describe(state.memory, with_tolerance);
  EXPECT_TRUE(text.starts_with("Parts that do not affect each other have their own steps. ")) << text;
  EXPECT_EQ(std::ranges::count(text, ':'), 2) << text;
  EXPECT_TRUE(is_tolerance_met(*state.memory.choice, with_tolerance));
  double cost = 0.0;
  for (const MethodChoice& choice : state.memory.islands) cost += choice.cost;
  EXPECT_EQ(state.memory.choice->cost, cost);
}

}  // namespace
}  // namespace hooke
