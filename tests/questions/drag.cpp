// A free point at 1 m/s with drag c = 10 1/s: its velocity after one second, for an increasing number of steps.
#include <algorithm>
#include <cmath>

#include "question.h"
#include "sim/methods/integrator.h"
#include "support/test_sim.h"

namespace hooke {

Answer why_drag_is_an_exponential() {
  constexpr double c = 10.0;
  const double exact = std::exp(-c);
  Answer answer{{.title = "Velocity after 1 s of drag from 1 m/s, c = 10 1/s",
                 .x = "steps in that second",
                 .y = "velocity [m/s]",
                 .log_x = true,
                 .log_y = true,
                 .series = {{"v = v (1 - c h)", {}}, {"v = v exp(-c h)", {}}, {"Hooke, symplectic Euler", {}}, {"exact", {}}}},
                {}};
  double worst = 0.0;
  for (const int steps : {1, 2, 3, 4, 5, 7, 9, 11, 14, 20, 30, 60, 120, 300, 1000}) {
    const double h = 1.0 / steps;
    double linear = 1.0, exponential = 1.0;
    for (int i = 0; i < steps; ++i) {
      linear *= 1.0 - c * h;
      exponential *= std::exp(-c * h);
    }
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    sim.system.drag = c;
    const PointId point = sim.add({0.0, 0.0, 0.0}, 1.0, {1.0, 0.0, 0.0});
    sim.run(*find_integrator("symplectic_euler"), 1.0, steps);
    const double measured = sim.velocity(point).x;
    worst = std::max({worst, std::abs(exponential / exact - 1.0), std::abs(measured / exact - 1.0)});

    auto& series = answer.chart.series;
    series[0].points.push_back({steps, std::abs(linear)});
    series[1].points.push_back({steps, exponential});
    series[2].points.push_back({steps, measured});
    series[3].points.push_back({steps, exact});
  }
  answer.expect(worst < 1e-11, "the exponential is exact for any number of steps");
  answer.expect(answer.chart.series[0].points[1].second > 10.0, "1 - c h grows where c h > 2");
  return answer;
}

}  // namespace hooke
