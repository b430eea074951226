#include "ui/plot_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hooke {

std::vector<double> PlotAxis::ticks() const {
  std::vector<double> list;
  constexpr double round_off = 1e-9;
  const double first = std::ceil(least / step - round_off);
  for (double i = first; i * step <= most + round_off * step && list.size() < 50; ++i) list.push_back(i == 0.0 ? 0.0 : i * step);
  return list;
}

std::string PlotAxis::label(double tick) const {
  const double largest = std::max(std::abs(least), std::abs(most));
  char text[40];
  if (largest >= 1e5 || largest < 1e-3)
    std::snprintf(text, sizeof text, "%.3g", tick);
  else
    std::snprintf(text, sizeof text, "%.*f", std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9))), tick);
  return text;
}

PlotAxis fit_axis(double least, double most, int ticks) {
  if (!std::isfinite(least) || !std::isfinite(most)) return {};
  // as flat as round-off leaves it: a scale around the value
  const double largest = std::max(std::abs(least), std::abs(most));
  if (most - least <= 1e-12 * largest || most <= least) {
    const double half = largest > 0.0 ? 0.5 * largest : 0.5;
    least -= half;
    most += half;
  }
  constexpr double room = 0.06;
  const double range = most - least;
  PlotAxis axis{.least = least - room * range, .most = most + room * range};
  const double rough = range / std::max(1, ticks), decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double first_digits = rough / decade;
  axis.step = decade * (first_digits < 1.5 ? 1.0 : first_digits < 3.5 ? 2.0 : first_digits < 7.5 ? 5.0 : 10.0);
  return axis;
}

}  // namespace hooke
