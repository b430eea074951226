// The scale of a plot: round numbers between the ends of what is shown.
#pragma once

#include <string>
#include <vector>

namespace hooke {

struct PlotAxis {
  double min = 0.0, max = 1.0;
  double step = 1.0;  // between ticks: 1, 2 or 5 x 10^n

  // The first tick and all after it within the ends.
  std::vector<double> ticks() const;
  // With as many decimals as the step needs: "0.25"; powers of ten for what is very large or small.
  std::string label(double tick) const;
  // Where a value lies, from 0 to 1.
  double fraction(double value) const { return (value - min) / (max - min); }
};

// Around values from `least` to `most`, with about `ticks` ticks and a little room. What is flat gets a scale all the same.
PlotAxis fit_axis(double min, double max, int ticks);

}  // namespace hooke
