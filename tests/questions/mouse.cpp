// Stiffness and mouse speeds that are too large for the step.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "question.h"
#include "sim/forces/energy/energy.h"
#include "sim/methods/integrator.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// n x n free points of 0.01 kg with a spacing of 0.1 m and structural springs.
TestSim net(int n, double stiffness) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  std::vector<PointId> ids;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) ids.push_back(sim.add({0.1 * column, -0.1 * row, 0.0}, 0.01));
  for (int i = 0; i < n * n; ++i) {
    if (i % n + 1 < n) sim.join(ids[i], ids[i + 1], stiffness, 0.1);
    if (i / n + 1 < n) sim.join(ids[i], ids[i + n], stiffness, 0.1);
  }
  return sim;
}

double largest_strain(const TestSim& sim) {
  double max = 0.0;
  for (const Spring& spring : sim.system.springs()) {
    const double now = std::abs(strain(sim.system, sim.state, spring));
    max = std::isfinite(now) ? std::max(max, now) : 1e9;
  }
  return std::min(max, 1e9);
}

// The largest strain while a net whose top row is nailed falls for one second.
double max_strain_falling(const char* method, double stiffness, int substeps) {
  TestSim sim = net(8, stiffness);
  sim.system.gravity = Vec3(0.0, -9.81, 0.0);
  for (int i = 0; i < 8; ++i) sim.system.point(i).nailed = true;
  double max = 0.0;
  for (int frame = 0; frame < 60 && max < 1e6; ++frame) {
    sim.run(*find_integrator(method), 1.0 / 60.0, substeps);
    max = std::max(max, largest_strain(sim));
  }
  return max;
}

// The largest strain while a hand moves a corner by 0.5 m at `speed`, exactly or with limited speed.
double max_strain_pulled(GrabKind kind, double speed, double top_speed) {
  TestSim sim = net(8, 1e4);
  const Vec3 start = sim.state.position[0];
  sim.system.grab = Grab{.point = sim.system.points()[0].id, .kind = kind, .stiffness = 200.0};
  sim.state.hand = {.position = start, .target = start};
  double max = 0.0;
  constexpr double frame_time = 1.0 / 60.0;
  for (int frame = 0; frame < 60; ++frame) {
    const double mouse = std::min(speed * (frame + 1) * frame_time, 0.5);
    Vec3& target = sim.state.hand.target;
    target = start + Vec3(-std::min(mouse, start.x - target.x + top_speed * frame_time), 0.0, 0.0);
    sim.run(*find_integrator("velocity_verlet"), frame_time, 80);
    max = std::max(max, largest_strain(sim));
  }
  return max;
}

}  // namespace

Answer why_large_constants_explode() {
  constexpr int substeps = 20;
  Answer answer{{.title = "A falling net of increasing stiffness, 20 substeps per frame",
                 .x = "h omega, omega of the fastest mode (Verlet is stable below 2)",
                 .y = "largest strain within 1 s",
                 .log_x = true,
                 .log_y = true,
                 .series = {{"explicit_euler", {}}, {"velocity_verlet", {}}, {"xpbd", {}}, {"tr_bdf2", {}}},
                 .y_range = "[1e-7:1e7]"},
                {}};
  for (double h_omega = 0.25; h_omega < 40.0; h_omega *= std::sqrt(2.0)) {
    // at most omega^2 = 8 k / m in a square net
    const double omega = h_omega * 60.0 * substeps, stiffness = 0.01 * omega * omega / 8.0;
    for (Series& series : answer.chart.series)
      series.points.push_back({h_omega, max_strain_falling(series.name.c_str(), stiffness, substeps)});
  }
  for (const auto& [x, y] : answer.chart.series[1].points) {
    if (x < 1.9) answer.expect(y < 1.0, "Verlet is stable below h omega = 2");
    if (x > 3.0) answer.expect(y > 100.0, "Verlet blows up well beyond it");
  }
  for (const auto& [x, y] : answer.chart.series[3].points) answer.expect(y < 1.0, "TR-BDF2 is stable everywhere");
  return answer;
}

Answer what_a_fast_mouse_does() {
  Answer answer{{.title = "A hand moves the corner of a free net (k = 1e4) by half a meter",
                 .x = "speed of the mouse [m/s]",
                 .y = "largest strain",
                 .log_x = true,
                 .log_y = true,
                 .series = {{"held at the mouse", {}}, {"held, limited to 2 m/s", {}}, {"pulled by a spring, 200 N/m", {}}}},
                {}};
  for (const double speed : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0}) {
    answer.chart.series[0].points.push_back({speed, max_strain_pulled(GrabKind::Hold, speed, 1e3)});
    answer.chart.series[1].points.push_back({speed, max_strain_pulled(GrabKind::Hold, speed, 2.0)});
    answer.chart.series[2].points.push_back({speed, max_strain_pulled(GrabKind::Pull, speed, 1e3)});
  }
  const auto last = [&](int s) { return answer.chart.series[s].points.back().second; };
  answer.expect(last(0) > 3.0 * last(1), "a hand of limited speed stretches the net far less");
  answer.expect(last(0) > 3.0 * last(2), "so does a hand that pulls with a spring");
  return answer;
}

}  // namespace hooke
