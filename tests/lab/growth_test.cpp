// Whether small differences grow exponentially, from distances over time.
#include "lab/accuracy/growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace hooke {
namespace {

// After `seconds` at 60 frames per second.
double rate_of(const std::function<double(double)>& distance, double seconds) {
  constexpr double frame = 1.0 / 60.0;
  GrowthMeasurement growth;
  growth.start(distance(0.0), frame);
  for (int i = 1; i <= std::lround(seconds / frame); ++i) growth.add(distance(i * frame), 1.0);
  return growth.result() ? growth.result()->rate : -1.0;
}

TEST(Growth, ExponentialHasItsRate) {
  for (const double rate : {4.0, 6.0, 10.0}) {
    EXPECT_NEAR(rate_of([&](double t) { return 1e-9 * std::exp(rate * t); }, 1.0), rate, 0.05 * rate);
    EXPECT_NEAR(rate_of([&](double t) { return 1e-9 * std::exp(rate * t) * (1.2 + std::sin(40.0 * t)); }, 1.0), rate, 0.2 * rate);
  }
}

TEST(Growth, RegularMotionHasNone) {
  EXPECT_EQ(rate_of([](double t) { return 1e-9 * (1.0 + 30.0 * t); }, 8.0), 0.0);
  EXPECT_EQ(rate_of([](double t) { return 1e-9 * std::abs(std::cos(20.0 * t)); }, 8.0), 0.0);
}

// A point slides off a block: at speed v, a difference d along the block makes it start falling d / v sooner.
TEST(Growth, OneEventIsNotExponential) {
  for (const double speed : {0.1, 0.3, 1.0})
    for (double event = 0.1; event < 1.0; event += 0.037) {
      const double d = 1e-9, late = 9.81 * d / speed;
      EXPECT_EQ(rate_of([&](double t) { return std::hypot(d, late * std::max(0.0, t - event)); }, 1.0), 0.0) << speed << ' ' << event;
    }
}

// A ball among others: each impact multiplies the difference of the velocities.
TEST(Growth, RepeatedEventsAreExponential) {
  for (const double interval : {0.09, 0.15, 0.2}) {
    const auto distance = [&](double time) {
      double d = 1e-9, slope = 1e-9;
      for (double t = 0.0; t < time; t += interval) {
        d += slope * std::min(interval, time - t);
        slope *= 4.0;
      }
      return d;
    };
    EXPECT_GT(rate_of(distance, 1.0), 0.5 * std::log(4.0) / interval) << interval;
  }
}

}  // namespace
}  // namespace hooke
