// Every method of the table on what it declares: order, amplification, and where each is strong.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "nets.h"

namespace hooke {
namespace {

const Integrator& method(std::string_view id) { return *find_integrator(id); }

// Every error falls by 2^order, from both sides, as the step is halved from seconds / steps.
void expect_order(const Integrator& row, const Trial& start, double seconds, int steps, double order) {
  const auto at = [&](int n) {
    Trial trial = start;
    trial.run(row, seconds, n);
    return trial.state;
  };
  const State h = at(steps), half = at(2 * steps), quarter = at(4 * steps);
  EXPECT_NEAR(std::log2(distance(h, half) / distance(half, quarter)), order, 0.12)
      << row.id << ", differences " << distance(h, half) << ", " << distance(half, quarter);
}

TEST(BlanesMoan, IsOfFourthOrderAlsoWithDragAndOfSecondWithDashpots) {
  const Integrator& row = method("blanes_moan4");
  Trial net2 = net(16, 1e2, 0.0);
  expect_order(row, net2, 0.25, 120, row.order);
  net2.system.drag = 2.0;
  expect_order(row, net2, 0.25, 120, row.order_drag);
  expect_order(row, net(16, 1e2, 0.9), 0.25, 160, row.order_damped);
}

// what Verlet does with the same number of force evaluations
TEST(BlanesMoan, BeatsVerletAtTheSameCost) {
  const auto error = [](const Integrator& row, int steps) {
    Trial trial = net(8, 1e2, 0.0), exact = trial;
    trial.run(row, 0.5, steps);
    exact.run(method("runge_kutta4"), 0.5, 20000);
    return distance(trial.state, exact.state);
  };
  EXPECT_LT(error(method("blanes_moan4"), 100), 1e-3 * error(method("velocity_verlet"), 600));
}

}  // namespace
}  // namespace hooke
