#include "ui/plot_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/number_text.h"

namespace hooke {

std::vector<double> PlotAxis::ticks() const {
  std::vector<double> list;
  constexpr double round_off = 1e-9;
  const double first = std::ceil(min / step - round_off);
  for (double i = first; i * step <= max + round_off * step && list.size() < 50; ++i) list.push_back(i == 0.0 ? 0.0 : i * step);
  return list;
}

std::string PlotAxis::label(double tick) const {
  const double largest = std::max(std::abs(min), std::abs(max));
  if (largest >= 1e5 || largest < 1e-3) return number_text(tick, 3);
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9))), tick);
  return text;
}

PlotAxis fit_axis(double min, double max, int ticks) {
  if (!std::isfinite(min) || !std::isfinite(max)) return {};
  // constant up to round-off: a range around the value
  const double largest = std::max(std::abs(min), std::abs(max));
  if (max - min <= 1e-12 * largest || max <= min) {
    const double half = largest > 0.0 ? 0.5 * largest : 0.5;
    min -= half;
    max += half;
  }
  constexpr double margin = 0.06;
  const double range = max - min;
  PlotAxis axis{.min = min - margin * range, .max = max + margin * range};
  const double raw_step = range / std::max(1, ticks), decade = std::pow(10.0, std::floor(std::log10(raw_step)));
  const double mantissa = raw_step / decade;
  axis.step = decade * (mantissa < 1.5 ? 1.0 : mantissa < 3.5 ? 2.0 : mantissa < 7.5 ? 5.0 : 10.0);
  return axis;
}

void LogAxis::include(double value) {
  const double decade = std::log10(value);
  const int below = static_cast<int>(std::floor(decade)), above = static_cast<int>(std::ceil(decade));
  min = is_empty ? below : std::min(min, below);
  max = std::max(is_empty ? above : std::max(max, above), min + 1);
  is_empty = false;
}

float LogAxis::fraction(double value) const { return static_cast<float>((std::log10(value) - min) / (max - min)); }

}  // namespace hooke
