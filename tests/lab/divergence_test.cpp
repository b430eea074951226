// Divergence stops a run and is explained.
#include "lab/divergence_message.h"
#include "lab/lab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene/step_advice.h"
#include "sim/methods/integrator.h"
#include "support/apply_now.h"
#include "support/small_net.h"

namespace hooke {
namespace {

TEST(Divergence, RecommendsAStableMethodWhereNoNumberOfSubstepsIsStable) {
  const Settings settings;
  const Advice advice = suggest_stepping(StepLimits({.omega = 1e12}), settings);
  EXPECT_EQ(advice.integrator, find_integrator("tr_bdf2"));
  EXPECT_EQ(advice.substeps, settings.substeps);
  EXPECT_EQ(suggest_stepping(StepLimits({.omega = 1e4}), settings).integrator, settings.integrator);
}

TEST(Divergence, PausesAtTheLastGoodFrameAndNamesWhatDiverged) {
  Scene scene = small_net();
  scene.settings.integrator = find_integrator("symplectic_euler");
  scene.settings.substeps = 1;  // omega h is about 3.5 here, above the limit 2
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s)->stiffness = 100.0;
  Lab lab(scene);
  lab.submit(SetRunning{true});
  for (int i = 0; i < 600 && lab.status()->diagnosis.message.empty(); ++i) lab.advance(1.0 / 60.0, [] { return true; });
  const Status& status = *lab.status();
  ASSERT_FALSE(status.diagnosis.message.empty());
  EXPECT_FALSE(status.run.running);
  EXPECT_TRUE(is_finite(status.snapshot->state));
  EXPECT_NE(status.diagnosis.message.find("point "), std::string::npos) << status.diagnosis.message;
  EXPECT_NE(status.diagnosis.message.find("spring "), std::string::npos) << status.diagnosis.message;
  ASSERT_TRUE(status.diagnosis.failed);
  EXPECT_EQ(status.diagnosis.failed->settings.substeps, 1);
  EXPECT_EQ(status.diagnosis.failed->start->state.time, 0.0);
}

TEST(Divergence, IsExplainedWithTheGrowthOfTheEnergyToTwoDigits) {
  const Scene scene = small_net();
  const auto message = [&](double growth) {
    return describe(
        {.kind = Divergence::Kind::EnergyGain, .time = 0.5, .energy = 2.0 * growth, .scale = 2.0, .point = scene.system.points()[1].id},
        scene.system);
  };
  EXPECT_EQ(message(6.04e5), "The simulation blew up at t = 0.5 s: energy grew 600,000-fold, first at point 1.");
  EXPECT_EQ(message(123.0), "The simulation blew up at t = 0.5 s: energy grew 120-fold, first at point 1.");
  EXPECT_EQ(message(1.26e7), "The simulation blew up at t = 0.5 s: energy grew 1.3\u00d710\u2077-fold, first at point 1.");
  EXPECT_EQ(message(3e40), "The simulation blew up at t = 0.5 s: energy grew 1×10⁴⁰-fold, first at point 1.");
}

TEST(Divergence, OfUndampedExplicitEulerRecommendsAStableMethod) {
  Scene scene = small_net();
  scene.settings.integrator = find_integrator("explicit_euler");
  Lab lab(scene);
  bool held = true;
  for (int i = 0; i < 6000 && held; ++i) held = lab.step();
  ASSERT_FALSE(held);
  lab.publish();
  EXPECT_NE(lab.status()->diagnosis.message.find(" s: energy grew "), std::string::npos) << lab.status()->diagnosis.message;
  EXPECT_NE(suggest_stepping(StepLimits(bound_spectrum(scene.system)), scene.settings).integrator, find_integrator("explicit_euler"));
}

// dashpots damp motion along the springs; transverse motion grows at every step
TEST(Divergence, OfDampedExplicitEulerWithinItsLimitRecommendsAStableMethod) {
  Scene scene = small_net();
  scene.settings.integrator = find_integrator("explicit_euler");
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s)->damping = 0.2;
  for (Index i = 4; i < 16; ++i) scene.state.velocity[i].z = 0.1;
  const double limit = largest_stable_step(*scene.settings.integrator, bound_spectrum(scene.system));
  scene.settings.substeps = static_cast<int>(std::ceil(1.0 / 60.0 / limit));
  Lab lab(scene);
  bool held = true;
  for (int i = 0; i < 6000 && held; ++i) held = lab.step();
  ASSERT_FALSE(held);
  lab.publish();
  EXPECT_NE(lab.status()->diagnosis.message.find(" s: energy grew "), std::string::npos) << lab.status()->diagnosis.message;
  EXPECT_NE(suggest_stepping(StepLimits(bound_spectrum(scene.system)), scene.settings).integrator, find_integrator("explicit_euler"));
}

// Springs between any points: nearly all of the matrix is filled. In the window, an exception would end the program.
TEST(Divergence, ANetworkThatIsTooLargeForTheMethodStopsTheRunWithAReason) {
  constexpr int points = 22'000, springs_per_point = 6;
  Scene scene;
  std::mt19937 random(1);
  std::vector<Point> added(points);
  std::vector<Spring> springs(static_cast<std::size_t>(points) * springs_per_point);
  for (int i = 0; i < points; ++i) added[i].id = PointId{static_cast<std::uint32_t>(i + 1)};
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const std::size_t first = s / springs_per_point, apart = 1 + random() % (points - 1);
    springs[s] = {
        .id = SpringId{static_cast<std::uint32_t>(s + 1)}, .first = added[first].id, .second = added[(first + apart) % points].id};
  }
  scene.system.set_points(std::move(added));
  scene.system.set_springs(springs);
  for (int i = 0; i < points; ++i) scene.state.position.emplace_back(0.01 * (i % 100), 1e-4 * i, 0.0);
  scene.state.velocity.resize(points);
  scene.settings.integrator = find_integrator("implicit_euler");
  scene.settings.substeps = 1;
  Lab lab(scene, KeepStart::No);
  EXPECT_FALSE(lab.step());
  lab.publish();
  EXPECT_TRUE(lab.status()->diagnosis.is_too_large);
  EXPECT_NE(lab.status()->diagnosis.message.find("too large for an implicit method"), std::string::npos) << lab.status()->diagnosis.message;
  EXPECT_FALSE(lab.status()->run.running);

  lab.submit(SetIntegrator{find_integrator("symplectic_euler")});
  EXPECT_TRUE(lab.step());
  lab.publish();
  EXPECT_EQ(lab.status()->diagnosis.message, "") << "a good frame ends the diagnosis";
}

}  // namespace
}  // namespace hooke
