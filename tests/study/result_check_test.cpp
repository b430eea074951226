// The check of a result against closed forms: what it calls independent is, and what it calls dependent is not.
#include "study/check/result_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/scene_file.h"
#include "sim/methods/integrator.h"
#include "study/forecast.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

constexpr double g = 9.81, pi = std::numbers::pi;
const Progress always = [](double) { return true; };

const CheckedQuantity& quantity(const ResultCheck& check, std::string_view name) {
  for (const CheckedQuantity& each : check.quantities)
    if (each.name == name) return each;
  throw std::runtime_error("no such quantity");
}

TestSim hanging_mass(double m, double k, double l0) {
  TestSim sim;
  const PointId nail = sim.nail(Vec3(0.0)), mass = sim.add({0.0, -l0, 0.0}, m);
  sim.join(nail, mass, k, l0, 0.0);
  return sim;
}

// At 240 Hz, frames and halves of them end at the same phase: the run would appear to be independent of the step.
TEST(ResultCheck, DoesNotCallUnresolvedOscillationsIndependentOfTheStep) {
  TestSim sim;
  sim.add({0.0, 0.1, 0.0});
  sim.system.colliders = {{.shape = Plane{}, .restitution = 0.5, .path = {.amplitude = {0.0, 1e-3, 0.0}, .frequency = 240.0}}};
  EXPECT_EQ(
      check_result(sim.system, sim.state, {.substeps = 1}, 0.5, always).note,
      "Not checked, because half the step may be as wrong: colliders[0].frequency: 240: is not resolved by 1 substep per frame; 64 are "
      "recommended.");
  EXPECT_EQ(check_result(sim.system, sim.state, {.substeps = 64}, 0.5, always).note, "");
}

TEST(ResultCheck, ThePeriodIsThatOfTheMethodWithItsStep) {
  // the pendulum is slower than the spring: omega = sqrt(g / (l0 + m g / k))
  const double m = 0.5, k = 50.0, l0 = 0.3;
  TestSim sim = hanging_mass(m, k, l0);
  Settings settings{.substeps = 1};
  const ResultCheck check = check_result(sim.system, sim.state, settings, 0.5, always);
  EXPECT_EQ(check.note, "");
  const double omega = std::sqrt(g / (l0 + m * g / k));
  // velocity Verlet: sin(omega' h / 2) = omega h / 2
  const auto period = [&](double h) { return pi * h / std::asin(0.5 * omega * h); };
  EXPECT_NEAR(*quantity(check, "period").now, period(1.0 / 60.0), 3e-6);
  EXPECT_NEAR(*quantity(check, "period").half_step, period(1.0 / 120.0), 3e-6);
  EXPECT_GT(std::abs(period(1.0 / 60.0) - period(1.0 / 120.0)), 1e-4);
  EXPECT_NEAR(*quantity(check, "sag").now, m * g / k, 1e-6);
  EXPECT_EQ(quantity(check, "sag").finer, std::nullopt);
  EXPECT_NE(check.sentence().find("no sheet or rope to refine"), std::string::npos) << check.sentence();
}

TEST(ResultCheck, AStepThatIsTooLongForTheMotionIsReported) {
  // h omega = 1.2 of the vertical vibration: the maximum strain is wrong by more than a percent
  TestSim sim = hanging_mass(0.5, 2592.0, 0.3);
  sim.state.velocity[1].y = -2.0;
  const ResultCheck coarse = check_result(sim.system, sim.state, {.substeps = 1}, 0.5, always);
  EXPECT_TRUE(coarse.sentence().starts_with("Depends on the step: ")) << coarse.sentence();
  const ResultCheck fine = check_result(sim.system, sim.state, {.substeps = 50}, 0.5, always);
  EXPECT_TRUE(fine.sentence().starts_with("Independent of the step (")) << fine.sentence();
  EXPECT_LT(*fine.distance, 0.01 * *coarse.distance);
}

// A rope of n points between nails at the same height, 1 m apart, straight and at its rest length.
TestSim catenary(int n) {
  const std::string file = R"({"hooke": 1, "generators": [{"type": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "points": )" +
                           std::to_string(n) + R"(, "mass": 0.4, "stiffness": 12, "mass_model": "tributary", "nail": ["from", "to"]}]})";
  Scene scene = parse_scene(file, "rope").scene;
  TestSim sim;
  sim.system = std::move(scene.system);
  sim.state = std::move(scene.state);
  sim.system.gravity = {0.0, -g, 0.0};
  return sim;
}

TEST(ResultCheck, TheSagOfARopeConvergesToTheElasticCatenary) {
  // half of it carries half the weight, 0.2 g, at its end: H horizontally (E. J. Routh 1891), s = unstretched arc,
  //   x = H s / EA + H / w asinh(w s / H),   y = w s^2 / (2 EA) + H / w (sqrt(1 + (w s / H)^2) - 1),   s up to 1/2
  const double w = 0.4 * g, stiffness = 12.0, s = 0.5;
  double low = 1e-3, high = 100.0;
  for (int i = 0; i < 200; ++i) {
    const double force = 0.5 * (low + high);
    const double x = force * s / stiffness + force / w * std::asinh(w * s / force);
    (x < 0.5 ? low : high) = force;
  }
  const double force = 0.5 * (low + high);
  const double exact = w * s * s / (2.0 * stiffness) + force / w * (std::sqrt(1.0 + std::pow(w * s / force, 2)) - 1.0);
  const auto sag_of = [](int n) {
    const TestSim sim = catenary(n);
    const ResultCheck check = check_result(sim.system, sim.state, {.substeps = 20}, 0.1, always);
    EXPECT_EQ(check.ropes, 1);
    EXPECT_NEAR(*quantity(check, "sag").half_step, *quantity(check, "sag").now, 1e-6);
    return quantity(check, "sag");
  };
  const CheckedQuantity coarse = sag_of(9), fine = sag_of(17);
  EXPECT_NEAR(*coarse.finer, *fine.now, 1e-9);
  // of second order in the length of a segment, from both sides
  const double order = std::log2((*coarse.now - *coarse.finer) / (*fine.now - *fine.finer));
  EXPECT_NEAR(order, 2.0, 0.2);
  // the shape without weight, from which the sag is measured, is known to a tenth of a millimeter
  EXPECT_NEAR(*sag_of(33).finer, exact, 2e-4);
  EXPECT_GT(*coarse.now - exact, 1e-3);
}

TEST(ResultCheck, ARopeOfFewPointsDependsOnResolutionAndOneOfManyPointsDoesNot) {
  const auto sentence = [](int n) {
    const TestSim sim = catenary(n);
    State rest = sim.state;
    rest.position = make_forecast(std::make_shared<const System>(sim.system), sim.state, {}, false).rest;
    return check_result(sim.system, rest, {.substeps = 20}, 0.2, always).sentence();
  };
  EXPECT_NE(sentence(8).find("depends on resolution: "), std::string::npos) << sentence(8);
  EXPECT_NE(sentence(60).find("independent of resolution ("), std::string::npos) << sentence(60);
}

TEST(ResultCheck, AMethodWhoseEquilibriumDependsOnTheStepIsReported) {
  // one sweep of XPBD does not carry the load along the rope
  TestSim sim = catenary(30);
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->stiffness *= 10.0;
  const ResultCheck check = check_result(sim.system, sim.state, {.integrator = find_integrator("xpbd"), .substeps = 4}, 0.3, always);
  const CheckedQuantity& sag = quantity(check, "sag");
  ASSERT_TRUE(sag.now && sag.half_step);
  EXPECT_GT(std::abs(*sag.now - *sag.half_step), 0.01 * *sag.half_step);
  EXPECT_TRUE(check.sentence().starts_with("Depends on the step: ")) << check.sentence();
}

TEST(ResultCheck, ARunThatDivergesHasNoResult) {
  TestSim sim = hanging_mass(0.5, 1e6, 0.3);
  sim.state.velocity[1].y = -1.0;
  const ResultCheck check = check_result(sim.system, sim.state, {.substeps = 1}, 1.0, always);
  EXPECT_EQ(check.sentence(), "The run diverges: use more substeps first.");
}

TEST(ResultCheck, CanBeStoppedAndReportsItsProgress) {
  const TestSim sim = catenary(20);
  double last = 0.0;
  int calls = 0;
  const ResultCheck check = check_result(sim.system, sim.state, {.substeps = 5}, 0.2, [&](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    last = fraction;
    return true;
  });
  EXPECT_EQ(check.note, "");
  EXPECT_GT(last, 0.9);
  EXPECT_EQ(check_result(sim.system, sim.state, {}, 1.0, [&](double) { return ++calls < 5; }).sentence(), "Stopped.");
}

}  // namespace
}  // namespace hooke
