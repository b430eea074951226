// The axis of a plot, with ticks at round numbers.
#pragma once

#include <string>
#include <vector>

namespace hooke {

struct PlotAxis {
  double min = 0.0, max = 1.0;
  double step = 1.0;  // between ticks: 1, 2 or 5 x 10^n

  // All ticks between min and max.
  std::vector<double> ticks() const;
  // With as many decimals as the step needs: "0.25"; in scientific notation for very large or small values.
  std::string label(double tick) const;
  // The relative position of a value, from 0 to 1.
  double fraction(double value) const { return (value - min) / (max - min); }
};

// An axis for values from `min` to `max`, with about `ticks` ticks and a margin. Equal values get a range around them.
PlotAxis fit_axis(double min, double max, int ticks);

// A logarithmic axis: the decades of the values, at least one.
struct LogAxis {
  int min = 0, max = 1;
  bool is_empty = true;

  void include(double value);
  float fraction(double value) const;
};

}  // namespace hooke
