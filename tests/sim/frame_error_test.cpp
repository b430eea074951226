// The estimated error of a frame against its true error.
#include <gtest/gtest.h>

#include "sim/frame_error.h"
#include "support/convergence.h"
#include "support/nets.h"

namespace hooke {
namespace {

class FrameError : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, FrameError, testing::ValuesIn(every_method()), method_name);

// A moving net: within a factor of three.
TEST_P(FrameError, IsTheDistanceToTheConvergedFrame) {
  Trial trial = net(8, 1e2, 0.0);
  trial.run(*find_integrator("runge_kutta4"), 0.2, 2000);
  const Settings settings{.integrator = &method(), .substeps = 4};
  Trial once = trial, exact = trial;
  once.run(method(), 1.0 / 60.0, 4);
  exact.run(*find_integrator("runge_kutta4"), 1.0 / 60.0, 1000);
  const double error = distance(once.state, exact.state), estimate = estimate_frame_error(trial.system, settings, trial.state);
  if (method().stability == Stability::Adaptive) {
    EXPECT_LT(error, 10.0 * estimate + 1e-12);
    return;
  }
  EXPECT_GT(estimate, error / 3.0);
  EXPECT_LT(estimate, error * 3.0);
}

TEST_P(FrameError, IsZeroWhereNothingMoves) {
  Trial trial;
  EXPECT_EQ(estimate_frame_error(trial.system, {.integrator = &method()}, trial.state), 0.0);
  trial.join(trial.nail(Vec3(0.0)), trial.nail({1.0, 0.0, 0.0}), 1e6, 0.5);
  EXPECT_EQ(estimate_frame_error(trial.system, {.integrator = &method()}, trial.state), 0.0);
}

}  // namespace
}  // namespace hooke
