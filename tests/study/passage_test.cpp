// Points that fall through the core of a central attraction: the warning before the run, the number of substeps that it recommends, and
// `auto`.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lab/accuracy/accuracy_text.h"
#include "scene/step_advice.h"
#include "sim/control/automatic.h"
#include "sim/forces/energy/energy.h"
#include "sim/methods/passage_step.h"
#include "study/hard_cases/monitored_run.h"
#include "support/force_with.h"
#include "support/parts.h"

namespace hooke {
namespace {

struct Fall {
  double distance = 1.0, strength = 1.0, power = 2.0, core = 0.01;
  Vec3 velocity{0.0, 0.004, 0.0};
};

TestNetwork network_of_fall(const Fall& fall) {
  TestNetwork network;
  network.system.gravity = Vec3(0.0);
  network.add(Vec3(-fall.distance, 0.003 * fall.distance, 0.0), 1.0, fall.velocity);
  network.system.forces = {force_with("center", {{"strength", fall.strength}, {"power", fall.power}, {"core", fall.core}})};
  initialize_supply(network.system, network.state);
  return network;
}

// [J], kinetic energy and that of the force, which is on one point.
double energy_of_fall(const TestNetwork& network, const State& state) {
  const Plan plan = make_plan(network.system);
  const Force& force = network.system.forces.front();
  const double x[] = {state.position[0].x, state.position[0].y, state.position[0].z};
  return kinetic_energy(network.system, state) + force.term->potential(plan, force.values, 0.0, x);
}

struct FallOutcome {
  double gain = 0.0;  // [J], of the energy, at most, where the point is far from the core: near it the energy oscillates
  State end;
};

FallOutcome fall(const TestNetwork& network, const Settings& settings, double seconds) {
  MonitoredRun run(network, settings);
  FallOutcome outcome;
  const double start = energy_of_fall(network, network.state);
  for (double t = 0.0; t < seconds; t += 0.1) {
    run.run(0.1);
    const bool is_far = glm::length(run.state().position[0]) > 0.5 * glm::length(network.state.position[0]);
    if (is_far) outcome.gain = std::max(outcome.gain, std::abs(energy_of_fall(network, run.state()) - start));
  }
  outcome.end = run.state();
  return outcome;
}

std::string warning_of_fall(const TestNetwork& network, const char* method, int substeps) {
  return step_warning(network.system, network.state, {.integrator = find_integrator(method), .substeps = substeps}).value_or("");
}

TEST(Passage, ThroughTheCoreIsWarnedAboutAlsoWithinTheLinearLimit) {
  const TestNetwork network = network_of_fall({});
  EXPECT_EQ(
      warning_of_fall(network, "velocity_verlet", 20),
      "simulation.substeps: 20: may be too few for velocity_verlet here: a point may pass the center of a force at 19 m/s and 0.01 m; "
      "552 are recommended");
  EXPECT_NE(warning_of_fall(network, "velocity_verlet", 5).find("its linear stability limit is 14 substeps"), std::string::npos);
  EXPECT_NE(warning_of_fall(network, "velocity_verlet", 5).find("; 552 are recommended"), std::string::npos)
      << warning_of_fall(network, "velocity_verlet", 5);
  EXPECT_EQ(warning_of_fall(network, "velocity_verlet", 552), "");
  EXPECT_EQ(warning_of_fall(network, "dop853", 1), "");
}

// An orbit that stays away from the core, and a scene at rest in it.
TEST(Passage, IsNotExpectedOfAPointThatStaysAway) {
  EXPECT_EQ(warning_of_fall(network_of_fall({.velocity = {0.0, 1.0, 0.0}}), "velocity_verlet", 56), "");
  EXPECT_EQ(warning_of_fall(network_of_fall({.distance = 1e-3, .velocity = Vec3(0.0)}), "velocity_verlet", 56), "");
  EXPECT_EQ(warning_of_fall(network_of_fall({.power = -1.0}), "velocity_verlet", 4), "");
}

TEST(Passage, TooFastForStepsOfOneLengthIsLeftToAMethodThatAdaptsThem) {
  const TestNetwork network = network_of_fall({.strength = 5.0, .power = 3.0, .core = 1e-3, .velocity = {3.0, 0.0, 0.0}});
  EXPECT_EQ(warning_of_fall(network, "velocity_verlet", 4),
            "simulation.integrator: velocity_verlet: needs more than 1,000,000 substeps per frame here");
  const FallOutcome outcome = fall(network, {.integrator = find_integrator("dop853"), .substeps = 4}, 1.0);
  EXPECT_LT(outcome.gain, 0.02 * energy_of_fall(network, network.state));
}

// The energy far from the core, which decides where the point goes, to a twentieth.
class Passages : public InParts<4> {};
INSTANTIATE_TEST_SUITE_P(Daily, Passages, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, Passages, testing::Range(1, Passages::parts));

TEST_P(Passages, KeepTheirEnergyWithTheRecommendedNumberOfSubsteps) {
  int number = 0;
  for (const char* id :
       {"symplectic_euler", "velocity_verlet", "blanes_moan4", "runge_kutta4", "implicit_midpoint", "tr_bdf2", "esdirk4", "xpbd"})
    for (const Fall& start :
         {Fall{}, Fall{.power = 0.5}, Fall{.power = 1.0}, Fall{.power = 1.5, .core = 3e-3}, Fall{.power = 3.0, .core = 0.1},
          Fall{.power = 4.0, .core = 0.2}, Fall{.core = 0.05, .velocity = {3.0, 0.0, 0.0}}}) {
      if (!has(number++)) continue;
      const TestNetwork network = network_of_fall(start);
      const Integrator& method = *find_integrator(id);
      const Spectrum spectrum = bound_spectrum(network.system);
      const Passage passage = shortest_passage(network.system, network.state);
      const auto substeps = StepLimits(spectrum, {.passage = passage}).recommended_substeps(method, 60.0);
      ASSERT_TRUE(substeps);
      const FallOutcome outcome = fall(network, {.integrator = &method, .substeps = *substeps}, 4.0);
      EXPECT_LT(outcome.gain, 0.05 * passage.energy) << id << " " << start.power << " " << *substeps;
    }
}

// The other center supplies most of the speed.
TEST(Passage, ThroughOneOfTwoCentersIsAsFastAsBothMakeIt) {
  TestNetwork network = network_of_fall({.distance = 5.0, .strength = 0.05, .velocity = Vec3(0.0)});
  network.system.forces.push_back(force_with("center", {{"x", 0.35}, {"strength", 10.0}, {"core", 0.3}}));
  network.state.position[0].y = 0.0;
  MonitoredRun run(network, {.integrator = find_integrator("velocity_verlet"), .substeps = 2000});
  double fastest = 0.0;
  for (int frame = 0; frame < 1200 && run.frame() && run.state().position[0].x < 0.0; ++frame)
    fastest = glm::length(run.state().velocity[0]);
  const Passage passage = shortest_passage(network.system, network.state);
  EXPECT_GT(passage.speed, fastest);
  EXPECT_LT(passage.speed, 1.5 * fastest);
}

// Points of a flat scene pass a center above or below them as if it were among them.
TEST(Passage, InAFlatSceneDoesNotDependOnTheHeightOfTheCenter) {
  TestNetwork network = network_of_fall({});
  network.system.dimensions = 2;
  const std::string warning = warning_of_fall(network, "velocity_verlet", 20);
  EXPECT_NE(warning.find("552 are recommended"), std::string::npos) << warning;
  network.system.forces[0].values[2] = 2.0;
  EXPECT_EQ(warning_of_fall(network, "velocity_verlet", 20), warning);
}

TEST(Passage, IsResolvedByTheAutomaticMethod) {
  for (const Fall& start : {Fall{}, Fall{.power = 1.0}, Fall{.power = 3.0, .core = 0.1}}) {
    const TestNetwork network = network_of_fall(start);
    const FallOutcome outcome = fall(network, {.integrator = &automatic_method(), .tolerance = 1e-3}, 4.0);
    const FallOutcome exact = fall(network, {.integrator = find_integrator("dop853"), .substeps = 4, .tolerance = 1e-10}, 4.0);
    // the passage amplifies the errors of the frames before it, each of which is within the tolerance
    EXPECT_LT(outcome.gain, 0.06);
    EXPECT_LT(glm::distance(outcome.end.position[0], exact.end.position[0]), 0.06) << start.power;
  }
}

}  // namespace
}  // namespace hooke
