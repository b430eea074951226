// The spectrum of a plot.
#include "study/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

TraceTable table_of(double frame_rate, int frames, double (*value)(double time)) {
  TraceTable table;
  table.traces.push_back({*find_quantity("kinetic", 1, 0), {}});
  for (int i = 0; i < frames; ++i) {
    table.times.push_back(i / frame_rate);
    table.continues.push_back(i == 0 ? 0 : 1);
    table.errors.push_back(0.0);
    table.traces[0].values.push_back(value(table.times.back()));
  }
  return table;
}

TEST(Spectrum, HasPeaksAtTheFrequenciesAndAmplitudesOfTheMotion) {
  const TraceTable table =
      table_of(60.0, 600, [](double t) { return 5.0 + 0.3 * std::sin(2.0 * M_PI * 1.7 * t) + 0.1 * std::cos(2.0 * M_PI * 6.0 * t); });
  const TraceTable spectrum = spectrum_of(table, 0.0, 10.0);
  const auto& amplitude = spectrum.traces.at(0).values;
  const auto peak_in = [&](double from, double to) {
    std::size_t best = 0;
    for (std::size_t k = 0; k < amplitude.size(); ++k)
      if (spectrum.times[k] > from && spectrum.times[k] < to && amplitude[k] > amplitude[best]) best = k;
    return best;
  };
  const std::size_t first = peak_in(1.0, 3.0);
  EXPECT_NEAR(spectrum.times[first], 1.7, 0.02);
  EXPECT_NEAR(amplitude[first], 0.3, 0.01);
  double second = 0.0;
  for (std::size_t k = 0; k < amplitude.size(); ++k)
    if (spectrum.times[k] > 5.0 && spectrum.times[k] < 7.0) second = std::max(second, amplitude[k]);
  EXPECT_NEAR(second, 0.1, 0.005);
  // nothing is shown far above the motion
  EXPECT_LT(spectrum.times.back(), 10.0);
}

// A decay beside an oscillation has the largest amplitudes at frequencies of less than two periods, where no peak is found.
TEST(Spectrum, NamesThePeakOfTheOscillationAndNotOfADrift) {
  const TraceTable table = table_of(60.0, 355, [](double t) { return 2.0 * std::exp(-0.3 * t) + 0.1 * std::sin(2.0 * M_PI * 1.15 * t); });
  const TraceTable spectrum = spectrum_of(table, 0.0, 10.0);
  const auto peak = peak_of(spectrum, {&spectrum.traces.at(0)});
  ASSERT_TRUE(peak);
  EXPECT_NEAR(*peak, 1.15, 0.05);
  const TraceTable drift = spectrum_of(table_of(60.0, 355, [](double t) { return 2.0 * std::exp(-0.3 * t); }), 0.0, 10.0);
  EXPECT_FALSE(peak_of(drift, {&drift.traces.at(0)}));
}

// Of any number of values: 2.4 periods of 2 s.
TEST(Spectrum, FindsAPeriodOfLessThanHalfOfTheTime) {
  for (const int frames : {257, 289, 300, 311}) {
    const TraceTable table = table_of(frames / 4.8, frames, [](double t) { return std::sin(M_PI * t); });
    const TraceTable spectrum = spectrum_of(table, 0.0, 10.0);
    const auto peak = peak_of(spectrum, {&spectrum.traces.at(0)});
    ASSERT_TRUE(peak) << frames;
    EXPECT_NEAR(*peak, 0.5, 0.04) << frames;
  }
}

TEST(Spectrum, OfTooFewValuesIsEmpty) {
  EXPECT_TRUE(spectrum_of(table_of(60.0, 5, [](double t) { return t; }), 0.0, 1.0).times.empty());
}

}  // namespace
}  // namespace hooke
