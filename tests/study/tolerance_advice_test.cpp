// Advice of the command line on the tolerance of a run: what it says is what a run with it shows.
#include <gtest/gtest.h>

#include <cmath>

#include "lab/accuracy/accuracy_text.h"
#include "sim/control/automatic.h"
#include "study/cost_advice.h"
#include "support/measured_lab.h"

namespace hooke {
namespace {

Scene vibration(const Settings& settings) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.join(sim.nail(Vec3(0.0)), sim.add(Vec3(1.5, 0.0, 0.0), 1.0), 100.0, 1.0);
  return scene_of(sim, settings);
}

Accuracy run(const Scene& scene, double seconds) {
  Lab lab = measured_lab(scene);
  for (int frame = 0; frame < std::lround(60.0 * seconds); ++frame) lab.step();
  return lab.accuracy();
}

TEST(ToleranceAdvice, IsWhatARunWithItShows) {
  const Settings coarse{.integrator = find_integrator("implicit_euler"), .substeps = 1};
  const auto advice = advise_on_tolerance(vibration(coarse), 24, run(vibration(coarse), 0.4));
  const Accuracy with_it = run(vibration({.integrator = &automatic_method(), .tolerance = 0.02}), 0.4);
  ASSERT_TRUE(advice && with_it.accumulated.value);
  const double error = std::max(*with_it.accumulated.value, with_it.max_accumulated.error);
  EXPECT_EQ(*advice,
            "With auto and a tolerance of 0.02 m/s, a copy of this run has an accumulated error of at most " + length_text(error) + ".");
}

TEST(ToleranceAdvice, IsNotGivenWhereNothingIsWrongOrItTakesTooLong) {
  const Settings fine{.integrator = find_integrator("runge_kutta4"), .substeps = 20},
      coarse{.integrator = find_integrator("implicit_euler"), .substeps = 1};
  EXPECT_FALSE(advise_on_tolerance(vibration(fine), 24, run(vibration(fine), 0.4)));
  EXPECT_FALSE(advise_on_tolerance(vibration(coarse), 60000000, run(vibration(coarse), 0.4)));
}

}  // namespace
}  // namespace hooke
