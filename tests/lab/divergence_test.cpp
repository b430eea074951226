// Divergence stops a run and is explained.
#include "lab/divergence_message.h"
#include "lab/lab.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/step_limits.h"
#include "sim/integrator.h"
#include "support/apply_now.h"
#include "support/small_net.h"

namespace hooke {
namespace {

TEST(Divergence, RecommendsAStableMethodWhereNoNumberOfSubstepsIsStable) {
  const Settings settings;
  const Advice advice = suggest_stepping({.omega = 1e12}, settings);
  EXPECT_EQ(advice.integrator, find_integrator("tr_bdf2"));
  EXPECT_EQ(advice.substeps, settings.substeps);
  EXPECT_EQ(suggest_stepping({.omega = 1e4}, settings).integrator, settings.integrator);
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
  EXPECT_EQ(message(6.04e5), "The simulation blew up: energy grew 600,000-fold, first at point 1. Stopped at t = 0.5 s.");
  EXPECT_EQ(message(123.0), "The simulation blew up: energy grew 120-fold, first at point 1. Stopped at t = 0.5 s.");
  EXPECT_EQ(message(1.26e7), "The simulation blew up: energy grew 13,000,000-fold, first at point 1. Stopped at t = 0.5 s.");
  EXPECT_EQ(message(3e40), "The simulation blew up: energy grew 10^40-fold, first at point 1. Stopped at t = 0.5 s.");
}

TEST(Divergence, OfUndampedExplicitEulerRecommendsAStableMethod) {
  Scene scene = small_net();
  scene.settings.integrator = find_integrator("explicit_euler");
  Lab lab(scene);
  bool held = true;
  for (int i = 0; i < 6000 && held; ++i) held = lab.step();
  ASSERT_FALSE(held);
  lab.publish();
  EXPECT_NE(lab.status()->diagnosis.message.find("The simulation blew up: energy grew "), std::string::npos)
      << lab.status()->diagnosis.message;
  EXPECT_NE(suggest_stepping(bound_spectrum(scene.system), scene.settings).integrator, find_integrator("explicit_euler"));
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
  EXPECT_NE(lab.status()->diagnosis.message.find("The simulation blew up: energy grew "), std::string::npos)
      << lab.status()->diagnosis.message;
  EXPECT_NE(suggest_stepping(bound_spectrum(scene.system), scene.settings).integrator, find_integrator("explicit_euler"));
}

}  // namespace
}  // namespace hooke
