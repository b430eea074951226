// One column of a sheet (1 m, 1 kg/m^2, k = 200 N/m per spring, a square grid) oscillates vertically. For the same material in ever finer
// quads: how fast does its slowest mode decay?
#include <cmath>

#include "question.h"
#include "sim/methods/integrator.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

constexpr double length = 1.0, density = 1.0, stiffness = 200.0;  // [m], [kg/m^2], [N/m]

// Decay rate [1/s] of the slowest mode of n points spaced by `side`, the side of a quad.
double decay_rate(int n, double damping, double drag) {
  const double side = length / (n - 1), mass = density * side * side;
  const double q = M_PI / (2.0 * length);
  const double omega = 2.0 * std::sqrt(stiffness / mass) * std::sin(0.5 * q * side);
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.drag = drag;
  PointId above = sim.nail({0.0, 0.0, 0.0});
  for (int i = 1; i < n; ++i) {
    const PointId point = sim.add({0.0, -i * side, 0.0}, i == n - 1 ? 0.5 * mass : mass, {0.0, 0.01 * std::sin(q * i * side), 0.0});
    sim.join(above, point, stiffness, side, damping);
    above = point;
  }

  // of the mode: its displacement and velocity, and so its amplitude
  const auto amplitude = [&] {
    double x = 0.0, v = 0.0;
    for (int i = 1; i < n; ++i) {
      const double weight = sim.system.points()[i].mass * std::sin(q * i * side);
      x += weight * (sim.state.position[i].y + i * side);
      v += weight * sim.state.velocity[i].y;
    }
    return std::hypot(omega * x, v);
  };
  const double start = amplitude();
  const double period = 2.0 * M_PI / omega;
  sim.run(*find_integrator("runge_kutta4"), 4.0 * period, 4000 * (n - 1) / 4);
  return std::log(start / amplitude()) / (4.0 * period);
}

}  // namespace

Answer why_dashpots_scale() {
  constexpr double d = 0.2, b = 0.5;  // [N s/m] per spring, [N s/m] per square meter
  Answer answer{{.title = "The same sheet in ever finer quads",
                 .x = "quads along a side",
                 .y = "decay rate of the slowest mode [1/s]",
                 .log_x = true,
                 .log_y = true,
                 .series = {{"spring dashpots: d", {}},
                            {"spring dashpots: d times the side", {}},
                            {"point dampers: b times the area", {}},
                            {"point dampers: b", {}}}},
                {}};
  for (const int n : {5, 9, 17, 33, 65}) {
    const double quads = n - 1, side = length / quads, mass = density * side * side;
    auto& series = answer.chart.series;
    series[0].points.push_back({quads, decay_rate(n, d, 0.0)});
    series[1].points.push_back({quads, decay_rate(n, d * 8.0 * side, 0.0)});
    series[2].points.push_back({quads, decay_rate(n, 0.0, b * side * side / mass)});
    series[3].points.push_back({quads, decay_rate(n, 0.0, b / 64.0 / mass)});
  }
  const auto spread = [&](int s) { return answer.chart.series[s].points.back().second / answer.chart.series[s].points.front().second; };
  answer.expect(std::abs(spread(0) - 1.0) < 0.02, "dashpots of equal d damp a sheet equally at any resolution");
  answer.expect(spread(1) < 0.1, "the damping of dashpots proportional to the side of the quads vanishes with refinement");
  answer.expect(std::abs(spread(2) - 1.0) < 0.02, "point damping must be proportional to the area of the quads");
  answer.expect(spread(3) > 100.0, "otherwise point damping grows with refinement");
  return answer;
}

}  // namespace hooke
