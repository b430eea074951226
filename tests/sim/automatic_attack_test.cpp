// The method `auto` on random nets: nothing diverges or gains energy.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sim/forces/energy/energy.h"
#include "sim/step/divergence.h"
#include "support/automatic_runs.h"
#include "support/random_force_scene.h"

namespace hooke {
namespace {

class AutomaticAttack : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Tolerances, AutomaticAttack, testing::Values(1e-1, 1e-2, 1e-4));

// Fewer than the 120 and 150 scenes that were checked, to save time.
std::uint64_t scenes(std::uint64_t all) { return std::getenv("HOOKE_PRINT") != nullptr ? all : all / 4; }

// At the linear limit, a quarter of these nets gain energy with velocity_verlet (margin_test.cpp).
TEST_P(AutomaticAttack, NoRotatingNetGainsEnergy) {
  int gained = 0;
  for (std::uint64_t seed = 0; seed < scenes(120); ++seed) {
    TestSim sim = rotating_net(seed);
    initialize_supply(sim.system, sim.state);
    Plan plan = make_plan(sim.system);
    Frame frame;
    ToleranceMonitor monitor;
    const Settings settings = automatic(GetParam());
    const double start = compute_energy(sim.system, sim.state).total();
    constexpr int frames = 120;
    double last = 0.0;
    bool is_lost = false;
    for (int i = 0; i < frames && !is_lost; ++i) {
      sim.state = next_frame(plan, frame, sim.system, settings, sim.state);
      monitor.add_frame(settings, sim.state);
      const Energy energy = compute_energy(sim.system, sim.state);
      is_lost = find_divergence(sim.system, sim.state, energy).has_value();
      if (i >= frames - 30) last += energy.total() / 30.0;
    }
    const bool gains = is_lost || last - start > 0.2 * sim.state.supply.scale;
    if (gains && std::getenv("HOOKE_PRINT") != nullptr)
      std::printf("tolerance %g, net %d: %s, %s\n", GetParam(), static_cast<int>(seed), is_lost ? "diverged" : "gained energy",
                  monitor.warning().c_str());
    gained += gains ? 1 : 0;
  }
  EXPECT_EQ(gained, 0);
}

// Every kind of listed force, walls, wind, dashpots and the hand, with extreme parameters. A choice never takes long, and a frame without
// a result ends the run visibly.
TEST(AutomaticAttacks, AChoiceInAnySceneTakesLimitedTimeAndADivergedFrameMissesTheTolerance) {
  constexpr double max_ms = 6000.0;  // by the model, of the trials of a frame
  double max = 0.0;
  int beyond = 0, diverged = 0;
  for (std::uint64_t seed = 0; seed < scenes(150); ++seed) {
    TestSim sim = random_force_scene(seed, ForceSceneKind::Any);
    initialize_supply(sim.system, sim.state);
    Plan plan = make_plan(sim.system);
    Frame frame;
    ToleranceMonitor monitor;
    const Settings settings = automatic(1e-3);
    for (int i = 0; i < 30; ++i) {
      const double before = frame.trial_cost();
      const State next = next_frame(plan, frame, sim.system, settings, sim.state);
      max = std::max(max, frame.trial_cost() - before);
      EXPECT_LT(frame.trial_cost() - before, max_ms) << seed << ", frame " << i;
      if (find_divergence(sim.system, next, compute_energy(sim.system, next))) {
        EXPECT_FALSE(is_tolerance_met(*next.memory.choice, settings)) << seed << ", frame " << i;
        ++diverged;
        break;
      }
      sim.state = next;
      monitor.add_frame(settings, sim.state);
    }
    beyond += monitor.frames_beyond() > 0 ? 1 : 0;
  }
  if (std::getenv("HOOKE_PRINT") != nullptr)
    std::printf("%d with frames beyond the tolerance, %d diverged; trials of a frame: at most %.3g ms\n", beyond, diverged, max);
}

// Contact limits the step of every method, and springs as fast as these that of explicit ones: 65,536 substeps of an implicit one would
// take seconds a frame, for many more points minutes.
TEST(AutomaticAttacks, AFrameOfSpringsThatAreTooFastForContactTakesLimitedTime) {
  for (const double stiffness : {1e12, 1e14})
    for (const double speed : {0.0, 30.0}) {
      TestSim sim = net(12, stiffness, 0.0);
      sim.system.colliders.push_back({.shape = Plane{{0.0, -1.05, 0.0}, {0.0, 1.0, 0.0}}, .restitution = 0.5, .friction = 0.3});
      for (Index i = 0; i < sim.system.point_count(); ++i) {
        sim.system.point(i).nailed = speed == 0.0 && sim.system.points()[i].nailed;
        if (speed > 0.0) sim.state.velocity[i] = {0.3, -speed, 0.1};
      }
      Plan plan = make_plan(sim.system);
      Frame frame;
      const Settings settings = automatic(1e-3);
      constexpr double max_ms = 1500.0;  // by the model, of a frame with its trials
      for (int i = 0; i < 3; ++i) {
        const double before = frame.trial_cost();
        sim.state = next_frame(plan, frame, sim.system, settings, sim.state);
        EXPECT_LT(frame.cost(plan) + frame.trial_cost() - before, max_ms) << stiffness << " " << speed << ", frame " << i;
      }
    }
}

// The strain limit is imposed once per substep: shorter steps hardly help where it acts.
TEST(AutomaticAttacks, AStrainLimitThatIsExceededAllTheTimeTakesLimitedTime) {
  TestSim sim = net(8, 1e3, 0.0);
  sim.system.strain_limit = 0.02;
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->rest_length *= s % 2 == 0 ? 0.5 : 1.0;
  Plan plan = make_plan(sim.system);
  Frame frame;
  const Settings settings = automatic(1e-6);
  constexpr double max_ms = 60.0;  // by the model, of a frame with its trials, on average
  constexpr int frames = 20;
  double cost = 0.0;
  int beyond = 0;
  for (int i = 0; i < frames; ++i) {
    sim.state = next_frame(plan, frame, sim.system, settings, sim.state);
    cost += frame.cost(plan) / frames;
    beyond += is_tolerance_met(*sim.state.memory.choice, settings) ? 0 : 1;
  }
  EXPECT_LT(cost + frame.trial_cost() / frames, max_ms);
  EXPECT_GT(beyond, frames / 2);
}

}  // namespace
}  // namespace hooke
