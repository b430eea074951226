// The limits to which `bench --kernels` compares the time of a step.
#include "study/kernels/machine_limits.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

// Caches of 64 KiB and 1 MiB for each core. Roots and divisions take 0.4 ns per spring, 0.2 ns in single precision.
const MachineLimits machine{
    .double_precision = {.lanes = 8, .fma_rate = 1e11, .sqrt_time = 3e-10, .division_time = 1e-10},
    .single_precision = {.lanes = 16, .fma_rate = 2e11, .sqrt_time = 1.5e-10, .division_time = 0.5e-10},
    .triads = {{.level = "L1", .bytes = 32 << 10, .one_thread = 4e11, .two_threads = 8e11, .is_of_each_core = true},
               {.level = "L2", .bytes = 512 << 10, .one_thread = 2e11, .two_threads = 4e11, .is_of_each_core = true},
               {.level = "memory", .bytes = 192 << 20, .one_thread = 1e10, .two_threads = 1.5e10}}};

TEST(MachineLimits, ArithmeticIsDividedAmongThreads) {
  const double points = 64.0 * 64.0, springs = 4.0 * points;
  EXPECT_DOUBLE_EQ(shortest_time_per_spring(machine, {.points = points, .springs = springs}), 4e-10);
  EXPECT_DOUBLE_EQ(shortest_time_per_spring(machine, {.points = points, .springs = springs, .threads = 2}), 2e-10);
  EXPECT_DOUBLE_EQ(shortest_time_per_spring(machine, {.points = points, .springs = springs, .is_single = true}), 2e-10);
  EXPECT_DOUBLE_EQ(shortest_time_per_spring(machine, {.points = points, .springs = springs, .threads = 2, .is_single = true}), 1e-10);
}

// 13 values per point, four springs per point.
TEST(MachineLimits, SinglePrecisionMovesHalfTheBytes) {
  const double points = 1024.0 * 1024.0, springs = 4.0 * points;
  EXPECT_DOUBLE_EQ(shortest_time_per_spring(machine, {.points = points, .springs = springs}), 13.0 * 8.0 / 4.0 / 1e10);
  EXPECT_DOUBLE_EQ(shortest_time_per_spring(machine, {.points = points, .springs = springs, .is_single = true}), 13.0 * 4.0 / 4.0 / 1e10);
  EXPECT_DOUBLE_EQ(shortest_time_per_spring(machine, {.points = points, .springs = springs, .threads = 2}), 13.0 * 8.0 / 4.0 / 1.5e10);
}

// 7 values per point are 1.75 MiB: too much for one cache of 1 MiB, not for two.
TEST(MachineLimits, TwoThreadsHaveTwoCaches) {
  const double points = 32768.0, springs = 4.0 * points;
  EXPECT_DOUBLE_EQ(shortest_time_per_spring(machine, {.points = points, .springs = springs}), 13.0 * 8.0 / 4.0 / 1e10);
  EXPECT_DOUBLE_EQ(shortest_time_per_spring(machine, {.points = points, .springs = springs, .threads = 2}), 2e-10);
}

TEST(MachineLimits, AreMeasured) {
  const MachineLimits limits = measure_machine_limits(true);
  for (const ArithmeticLimits& each : {limits.double_precision, limits.single_precision}) {
    EXPECT_GE(each.lanes, 1);
    EXPECT_GT(each.fma_rate, 0.0);
    EXPECT_GT(each.sqrt_time, 0.0);
    EXPECT_GT(each.division_time, 0.0);
  }
  EXPECT_GE(limits.single_precision.lanes, limits.double_precision.lanes);
  ASSERT_EQ(limits.triads.size(), 4u);
  EXPECT_EQ(limits.triads.front().level, "L1");
}

}  // namespace
}  // namespace hooke
