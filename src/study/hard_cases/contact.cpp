// Impacts and the motion after them.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

constexpr double gravity_of_falls = 9.81;  // [m/s^2]

// A sheet of 1 m and 1 kg falls onto a ball on the ground.
Verdict judge_cloth_on_ball(const Integrator& method) {
  constexpr int n = 32;
  constexpr double radius = 0.3, drop = 2.0, a = 1.0 / (n - 1);
  constexpr Vec3 center{0.02, radius, 0.01};
  TestNetwork sheet = make_sheet({.rows = n,
                                  .columns = n,
                                  .corner = {-0.5, drop, -0.5},
                                  .across = {a, 0.0, 0.0},
                                  .down = {0.0, 0.0, a},
                                  .mass = 1.0 / (n * n),
                                  .stiffness = 1e6,
                                  .diagonal_stiffness = 1e6});
  sheet.system.colliders.push_back({.shape = Sphere{center, radius}, .restitution = 0.0, .friction = 0.5});
  sheet.system.colliders.push_back({.shape = Plane{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, .restitution = 0.0, .friction = 0.5});

  MonitoredRun run(sheet, settings_for(method, sheet.system, {.free = 4}), {.energy = 1e-3});
  // the default method for the whole duration, the others through the impact at 0.53 s
  const double seconds = &method == &default_integrator() ? 10.0 : 0.7;
  double deepest = 0.0;
  while (run.state().time < seconds && run.frame())
    for (const Vec3& x : run.state().position) deepest = std::max({deepest, radius - glm::distance(x, center), -x.y});
  const double rise = run.monitor().energy_rise();
  // at its stability limit, the energy of a first-order method fluctuates without bound
  return judge(
      run, method.order == 1 ? Expectation::HoldOrReport : expectation_of(run), deepest < 1e-3 && rise < 1e-3,
      formatted("penetration %.1g m, energy rises %.1g, %.3g s, %d substeps", deepest, rise, run.state().time, run.settings().substeps));
}

// 100 m/s onto a slab of 0.1 m, e = 0.5; a step of 1/60 s covers 1.7 m.
Verdict judge_fast_impact(const Integrator& method) {
  constexpr double e = 0.5, above = 1.2;
  TestNetwork network;
  network.add({0.0, above, 0.0}, 1.0, {0.0, -100.0, 0.0});
  network.system.colliders.push_back({.shape = Box{{-1.0, -0.1, -1.0}, {1.0, 0.0, 1.0}}, .restitution = e, .friction = 0.0});
  MonitoredRun run(network, {.integrator = &method, .substeps = 1});
  double highest = -1e300, lowest = 1e300;
  run.frame();
  for (int i = 0; i < 360 && run.frame(); ++i) {
    highest = std::max(highest, run.state().position[0].y);
    lowest = std::min(lowest, run.state().position[0].y);
  }
  const double impact_speed_squared = 100.0 * 100.0 + 2.0 * gravity_of_falls * above;
  const double error = highest / (e * e * impact_speed_squared / (2.0 * gravity_of_falls)) - 1.0;
  return judge(run, lowest >= -1e-9 && std::abs(error) < 0.01, formatted("rebound error %+.2g, lowest %.1g m", error, lowest));
}

// Dropped from 1 m, e = 0.9: at rest at t1 (1 + e) / (1 - e), t1 = sqrt(2 h / g), after ever smaller bounces.
Verdict judge_endless_bounces(const Integrator& method) {
  constexpr double e = 0.9, height = 1.0;
  const double rest = std::sqrt(2.0 * height / gravity_of_falls) * (1.0 + e) / (1.0 - e);
  std::vector<Verdict> parts;
  for (const int substeps : {1, 20}) {
    TestNetwork network;
    network.add({0.0, height, 0.0});
    network.system.colliders.push_back({.shape = Plane{}, .restitution = e, .friction = 0.0});
    MonitoredRun run(network, {.integrator = &method, .substeps = substeps}, {.position = 1e-3});
    double rest_time = 0.0, jitter = 0.0;
    while (run.state().time < rest + 2.0 && run.frame()) {
      const double up = std::abs(run.state().position[0].y) + std::abs(run.state().velocity[0].y) / 60.0;
      if (up > 1e-6) rest_time = run.state().time + 1.0 / 60.0;
      if (run.state().time > rest + 1.0 / 60.0) jitter = std::max(jitter, up);
    }
    // timing errors of half a step at every bounce accumulate in first-order methods
    const Expectation expected = method.order_with.contact == 1 ? Expectation::HoldOrReport : Expectation::Hold;
    parts.push_back(
        judge(run, expected, std::abs(rest_time - rest) <= 1.0 / 60.0 + 1e-9 && jitter <= 1e-6,
              formatted("%d substeps: at rest with a timing error of %+.3f s, then moves by %.1g m", substeps, rest_time - rest, jitter)));
  }
  return worst_of(parts);
}

}  // namespace

constinit const HardCase cloth_on_ball_case{
    .number = 19,
    .name = "Stiff cloth on a ball",
    .parameters =
        "32 x 32 points, 1 kg, k = 1e6 N/m, dropped from 2 m on a ball of 0.3 m on the ground, mu = 0.5, e = 0; 10 s with velocity_verlet",
    .criterion = "penetration < 1e-3 m, no energy gained (1e-3), finite",
    .remark =
        "the other methods run for 0.7 s, past the impact at 0.53 s, to bound the time of the check; first-order methods may fail openly "
        "at "
        "their stability limit",
    .slow = true,
    .judge = judge_cloth_on_ball,
};

constinit const HardCase fast_impact_case{
    .number = 20,
    .name = "High-speed impact",
    .parameters = "100 m/s onto a slab 0.1 m thick, e = 0.5, one step per frame",
    .criterion = "no tunneling, rebound height within 1 %",
    .judge = judge_fast_impact,
};

constinit const HardCase endless_bounces_case{
    .number = 21,
    .name = "Endless bounces",
    .parameters = "dropped from 1 m, e = 0.9, 1 and 20 substeps",
    .criterion = "at rest at t1 (1 + e) / (1 - e) within a frame, then moving by less than 1e-6 m",
    .judge = judge_endless_bounces,
};

}  // namespace hooke
