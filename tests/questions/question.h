// A common question, an experiment that answers it, a chart of the result, and the claims that must hold.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hooke {

struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

struct Chart {
  std::string title, x, y;
  bool log_x = false, log_y = false;
  std::vector<Series> series;
  std::string y_range;  // in gnuplot syntax; empty: automatic
};

struct Answer {
  Chart chart;
  std::vector<std::string> broken;  // claims of the page that the measurement contradicts
  void expect(bool holds, const char* claim) {
    if (!holds) broken.emplace_back(claim);
  }
};

Answer why_dashpots_scale();
Answer why_drag_is_an_exponential();
Answer why_a_pass_must_end();
Answer why_large_constants_explode();
Answer what_a_fast_mouse_does();
Answer why_explicit_euler_gains_energy();

}  // namespace hooke
