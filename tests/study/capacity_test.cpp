// The largest cloth in real time: the setting found is accurate enough, and about the cheapest that is.
#include "study/capacity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "study/kernels/kernel_cases.h"
#include "support/bench_problem.h"

namespace hooke {
namespace {

constexpr std::array small_sizes{6, 8};

CapacityResult measure(const char* method, double max_error) {
  const std::array methods{find_integrator(method)};
  return measure_capacity(
      methods, small_sizes, max_error, 0.3, [](int) {}, always);
}

// The cloth of the measurement, from its own reference; infinite if the run diverges.
double error_of(const char* method, int n, const Setting& setting) {
  Problem problem = make_problem("cloth", make_kernel_scene(kernel_cases().front(), n, 1));
  problem.seconds = 16.0 / capacity_frame_rate;
  problem.size = 1.0;
  Benchmark benchmark(problem);
  const RunResult exact = benchmark.run(*find_integrator("dop853"), {.tolerance = 1e-12}, always);
  const RunResult run = benchmark.run(*find_integrator(method), setting, always);
  if (run.end != RunResult::End::Finished) return HUGE_VAL;
  return judge(problem, Measure::Trajectory, exact.snapshots, run.snapshots).relative_error;
}

TEST(Capacity, TheSettingKeepsTheErrorAndHalfOfItDoesNot) {
  for (const char* method : {"velocity_verlet", "runge_kutta4", "implicit_midpoint"}) {
    const CapacityResult result = measure(method, 1e-4);
    EXPECT_EQ(result.reason, "");
    ASSERT_EQ(result.rows.size(), 1u);
    ASSERT_TRUE(result.rows[0].largest) << method;
    const Capacity& largest = *result.rows[0].largest;
    EXPECT_EQ(largest.n, 8);
    EXPECT_EQ(largest.springs, 2 * 8 * 7 + 2 * 7 * 7);
    EXPECT_FALSE(result.rows[0].is_bounded) << "larger cloths were not tried";
    EXPECT_LE(largest.relative_error, 1e-4);
    EXPECT_NEAR(error_of(method, 8, largest.setting), largest.relative_error, 1e-7) << method;
    EXPECT_GT(error_of(method, 8, {.steps = largest.setting.steps / 2}), 1e-4) << method;
  }
}

TEST(Capacity, AMethodThatCannotReachTheErrorHasNoCloth) {
  const CapacityResult result = measure("explicit_euler", 1e-7);
  EXPECT_FALSE(result.rows.at(0).largest);
  EXPECT_TRUE(result.rows.at(0).is_bounded);
}

TEST(Capacity, WithoutAReferenceItSaysWhy) {
  const CapacityResult result = measure("velocity_verlet", 1e-9 * 1e-9);
  EXPECT_EQ(result.largest_n, 0);
  EXPECT_NE(result.reason, "");
  EXPECT_FALSE(result.rows.at(0).largest);
}

}  // namespace
}  // namespace hooke
