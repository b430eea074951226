// The estimated error of a frame against its true error. With HOOKE_PRINT set, the table of docs/evidence/accuracy.md is printed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sim/control/frame_error.h"
#include "sim/control/frame_runner.h"
#include "support/accuracy_scenes.h"
#include "support/convergence.h"
#include "support/next_frame.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

class FrameErrors : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, FrameErrors, testing::ValuesIn(every_method()), method_name);

// The reference frame, whose error is negligible compared with that of the method under test.
Settings exact(const AccuracyScene& scene) {
  if (scene.has_contact) return {.integrator = find_integrator("blanes_moan4"), .substeps = 1000};
  return {.integrator = find_integrator("dop853"), .substeps = 8, .tolerance = 1e-13};
}

// RMS over the points that are not nailed [m], as of the estimate.
double free_distance(const System& system, const State& first, const State& second) {
  const auto nailed = std::ranges::count(system.points(), true, &Point::nailed), all = std::ssize(system.points());
  return distance(first, second) * std::sqrt(static_cast<double>(all) / static_cast<double>(all - nailed));
}

struct Spread {
  double low = 1.0, median = 1.0, high = 1.0;  // quantiles 0.1, 0.5, 0.9 of estimate / error
  double error = 0.0;                          // [m], median
  std::size_t frames = 0;
};

Spread spread_of(const AccuracyScene& scene, const Integrator& method, int min_substeps) {
  TestSim sim = scene.make();
  Plan plan = make_plan(sim.system);
  FrameRunner stepper;
  Settings settings = accuracy_settings(method, sim.system);
  settings.substeps = std::max(settings.substeps, min_substeps);
  std::vector<double> ratios, errors;
  constexpr double round_off = 5e-14, diverged = 0.1;  // [m]
  for (int frame = 0; frame < 60; ++frame) {
    const State after = next_frame(plan, stepper, sim.system, settings, sim.state);
    if (frame % 3 == 0) {
      const double error = free_distance(sim.system, after, next_frame(plan, stepper, sim.system, exact(scene), sim.state));
      if (!(error < diverged)) break;
      if (error > round_off) {
        ratios.push_back(estimate_frame_error(sim.system, settings, sim.state) / error);
        errors.push_back(error);
      }
    }
    sim.state = after;
  }
  if (ratios.empty()) return {};
  std::ranges::sort(ratios);
  std::ranges::sort(errors);
  const auto at = [](const std::vector<double>& values, double quantile) {
    return values[static_cast<std::size_t>(quantile * static_cast<double>(values.size() - 1))];
  };
  return {at(ratios, 0.1), at(ratios, 0.5), at(ratios, 0.9), at(errors, 0.5), ratios.size()};
}

void expect_median(const AccuracyScene& scene, const Integrator& method, int min_substeps) {
  const Spread spread = spread_of(scene, method, min_substeps);
  EXPECT_GT(spread.median, 0.5) << scene.name;
  EXPECT_LT(spread.median, 2.2) << scene.name;
  if (std::getenv("HOOKE_PRINT") != nullptr && spread.frames > 0)
    std::printf("| `%s` | %s | %.2f | %.2f .. %.2f | %.0e |\n", std::string(method.id).c_str(), std::string(scene.name).c_str(),
                spread.median, spread.low, spread.high, spread.error);
}

TEST_P(FrameErrors, TheMedianEstimateIsTheDistanceToTheConvergedFrame) {
  for (const AccuracyScene& scene : accuracy_scenes()) expect_median(scene, method(), 1);
}

// Impacts, folds and friction included: several tenths of a millimeter per frame, of which nothing is left without contact.
class FrameErrorsInContact : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, FrameErrorsInContact, testing::ValuesIn(methods_that(can_be_stable)), method_name);

TEST_P(FrameErrorsInContact, TheMedianEstimateAccountsForContact) {
  for (const AccuracyScene& scene : contact_accuracy_scenes()) expect_median(scene, method(), 10);
}

// Methods that split off dashpots which decay within a part of a step are no reference for the others: their error may be a million times
// as large.
TEST(FrameErrorsWithFastDashpots, TheEstimateOfAnImplicitMethodIsItsError) {
  for (const double damping : {9.0, 1e2, 1e3})
    for (const char* id : {"implicit_euler", "baraff_witkin", "tr_bdf2", "esdirk4"})
      for (const int substeps : {1, 4}) {
        const TestSim sim = net(8, 1e4, damping);
        const Settings settings{.integrator = find_integrator(id), .substeps = substeps};
        const Settings reference{.integrator = find_integrator("dop853"), .tolerance = 1e-13};
        Plan plan = make_plan(sim.system);
        FrameRunner frame;
        const State truth = next_frame(plan, frame, sim.system, reference, sim.state);
        const double error = free_distance(sim.system, truth, next_frame(plan, frame, sim.system, settings, sim.state));
        const double estimate = estimate_frame_error(sim.system, settings, sim.state);
        EXPECT_GT(estimate, error / 1.5) << damping << " " << id << " " << substeps;
        EXPECT_LT(estimate, error * 1.5) << damping << " " << id << " " << substeps;
      }
}

// Nets of two to five points with dashpots that fall onto a floor, with and without friction: HOOKE_SEED sets the sequence.
TestSim damped_fall(Random& random) {
  TestSim sim;
  sim.system.dimensions = 2;
  const Index points = 2 + random.below(4);
  for (Index i = 0; i < points; ++i)
    sim.add({random.uniform(-0.5, 0.5), random.uniform(0.05, 0.5), 0.0}, random.uniform(0.2, 2.0),
            {random.uniform(-1.0, 1.0), random.uniform(-3.0, 0.0), 0.0});
  for (Index i = 0; i < points; ++i)
    for (Index j = 0; j < i; ++j)
      if (j == i - 1 || random.one_in(2))
        sim.join(sim.system.points()[j].id, sim.system.points()[i].id, std::pow(10.0, random.uniform(1.5, 3.0)),
                 glm::distance(sim.state.position[i], sim.state.position[j]), std::pow(10.0, random.uniform(-1.0, 1.0)));
  sim.system.colliders = {{.shape = Plane{}, .restitution = random.uniform(0.2, 1.0)}};
  if (random.one_in(2)) sim.system.colliders.front().friction = random.uniform(0.1, 0.6);
  return sim;
}

// even where impacts fall early in a substep, and dashpots act for the rest of it
TEST(FrameErrorsInDampedContact, TheEstimateIsSeldomLessThanAThirdOfTheError) {
  const char* seed = std::getenv("HOOKE_SEED");
  Random random(seed != nullptr ? std::strtoull(seed, nullptr, 10) : 1);
  std::vector<double> ratios;
  const Settings settings{.integrator = find_integrator("velocity_verlet"), .substeps = 20};
  const Settings fine{.integrator = settings.integrator, .substeps = 1000};
  for (int scene = 0; scene < 20; ++scene) {
    TestSim sim = damped_fall(random);
    Plan plan = make_plan(sim.system);
    FrameRunner stepper;
    for (int frame = 0; frame < 20; ++frame) {
      const State after = next_frame(plan, stepper, sim.system, settings, sim.state);
      const bool has_touched = stepper.has_touched();
      const double error = distance(after, next_frame(plan, stepper, sim.system, fine, sim.state));
      if (has_touched && error > 1e-9) ratios.push_back(estimate_frame_error(sim.system, settings, sim.state) / error);
      sim.state = after;
    }
  }
  std::ranges::sort(ratios);
  ASSERT_GT(ratios.size(), 100U);
  EXPECT_GT(ratios[ratios.size() / 20], 1.0 / 3.0);
  EXPECT_LT(ratios[ratios.size() / 2], 2.2);
}

TEST_P(FrameErrors, IsZeroWhereNothingMoves) {
  TestSim sim;
  EXPECT_EQ(estimate_frame_error(sim.system, {.integrator = &method()}, sim.state), 0.0);
  sim.join(sim.nail(Vec3(0.0)), sim.nail({1.0, 0.0, 0.0}), 1e6, 0.5);
  EXPECT_EQ(estimate_frame_error(sim.system, {.integrator = &method()}, sim.state), 0.0);
}

}  // namespace
}  // namespace hooke
