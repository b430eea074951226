// Plot axes have round tick values for any data.
#include "ui/plot_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hooke {
namespace {

TEST(PlotAxis, HasTicksAtRoundNumbersAndMargins) {
  const PlotAxis axis = fit_axis(0.0, 10.0, 5);
  EXPECT_EQ(axis.step, 2.0);
  EXPECT_EQ(axis.ticks(), (std::vector<double>{0.0, 2.0, 4.0, 6.0, 8.0, 10.0}));
  EXPECT_LT(axis.min, 0.0);
  EXPECT_GT(axis.max, 10.0);
  EXPECT_EQ(axis.label(2.0), "2");
}

TEST(PlotAxis, LabelsDistinguishTicks) {
  for (const auto& [min, max] : {std::pair{-1.0, 1.0}, {0.001, 0.0017}, {1e6, 1.5e6}, {-3e-9, 2e-9}, {99.99, 100.01}}) {
    const PlotAxis axis = fit_axis(min, max, 4);
    const std::vector<double> ticks = axis.ticks();
    ASSERT_GE(ticks.size(), 2u);
    ASSERT_LE(ticks.size(), 9u);
    for (std::size_t i = 1; i < ticks.size(); ++i) EXPECT_NE(axis.label(ticks[i - 1]), axis.label(ticks[i])) << min << " to " << max;
  }
}

TEST(PlotAxis, OfConstantOrNonFiniteDataIsStillValid) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [min, max] : {std::pair{5.0, 5.0}, {0.0, 0.0}, {-7.0, -7.0}, {infinity, -infinity}, {1e300, 1e300}}) {
    const PlotAxis axis = fit_axis(min, max, 4);
    EXPECT_GT(axis.max, axis.min);
    EXPECT_GT(axis.step, 0.0);
    EXPECT_GE(axis.ticks().size(), 1u);
    EXPECT_LE(axis.ticks().size(), 50u);
  }
}

}  // namespace
}  // namespace hooke
