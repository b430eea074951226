// Invariance: distance from the origin, independent parts in one scene.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/methods/rows.h"
#include "study/analytic_scenes.h"
#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

State after(const TestNetwork& network, const Settings& settings, double seconds) {
  MonitoredRun run(network, settings);
  run.run(seconds);
  return run.state();
}

Verdict judge_large_coordinates(const Integrator& method) {
  constexpr double seconds = 0.5;
  const InitialState net = make_net(8, 1e2, 0.0);
  Settings settings = settings_for(method, net.system, {.min = 20, .free = 20});
  // an adaptive method chooses other steps if the last bits differ: equal within its tolerance
  if (is_adaptive(method)) settings.tolerance = 1e-12;
  const State here = after({net.system, net.state}, settings, seconds);

  std::vector<Verdict> parts;
  for (const double offset : {1e3, 1e5}) {
    TestNetwork moved{net.system, net.state};
    // offset by powers of two near it, so that only the bits lost by rounding differ
    const Vec3 by = Vec3(1.0, -0.5, 0.25) * std::exp2(std::round(std::log2(offset)));
    for (Vec3& x : moved.state.position) x += by;
    MonitoredRun run(moved, settings);
    run.run(seconds);
    double max = 0.0;
    for (std::size_t i = 0; i < here.position.size(); ++i)
      max = std::max(max, glm::distance(run.state().position[i] - by, here.position[i]));
    // no tolerance is below the rounding error of such coordinates
    parts.push_back(judge(run, max < (is_adaptive(method) ? 1e-8 : 1e-9), formatted("%.0e m away: error %.1g m", offset, max)));
  }
  return worst_of(parts);
}

Verdict judge_islands(const Integrator& method) {
  // a rope of k = 1e8 and a cloth of k = 1, both with their top nailed
  TestNetwork rope;
  PointId above = rope.nail({2.0, 0.0, 0.0});
  for (int i = 1; i < 20; ++i) {
    const PointId below = rope.add({2.0 + 0.05 * i, 0.0, 0.0}, 0.01);
    rope.join(above, below, 1e8);
    above = below;
  }
  TestNetwork cloth =
      make_sheet({.rows = 8, .columns = 8, .across = {0.1, 0.0, 0.0}, .down = {0.0, -0.1, 0.0}, .mass = 1e-3, .stiffness = 1.0});
  for (int i = 0; i < 8; ++i) cloth.system.point(i).nailed = true;

  TestNetwork both = cloth;
  PointId last{};
  for (Index i = 0; i < rope.system.point_count(); ++i) {
    const Point& point = rope.system.points()[i];
    const PointId id = point.nailed ? both.nail(rope.state.position[i]) : both.add(rope.state.position[i], point.mass);
    if (i > 0) both.join(last, id, 1e8);
    last = id;
  }

  constexpr double seconds = 0.5;
  const Settings settings = settings_for(method, both.system, {.free = 4});
  MonitoredRun soft_run(cloth, settings), stiff_run(rope, settings), run(both, settings);
  for (MonitoredRun* each : {&soft_run, &stiff_run, &run}) each->run(seconds);
  const State &soft = soft_run.state(), &stiff = stiff_run.state();
  double max = 0.0;
  for (std::size_t i = 0; i < 64; ++i) max = std::max(max, glm::distance(run.state().position[i], soft.position[i]));
  for (std::size_t i = 0; i < stiff.position.size(); ++i)
    max = std::max(max, glm::distance(run.state().position[64 + i], stiff.position[i]));
  // solves that reach their iteration limit end differently, and this is reported
  const Expectation expected = run.monitor().unconverged_solves() > 0 ? Expectation::HoldOrReport : expectation_of(run);
  // each run of `auto` may be off by its tolerance
  const double allowed = is_automatic(settings) ? 20.0 * seconds * automatic_tolerance(settings) : 1e-6;
  return judge(run, expected, max < allowed, formatted("difference %.1g m", max));
}

}  // namespace

constinit const HardCase large_coordinates_case{
    .number = 23,
    .name = "Large coordinates",
    .parameters = "net of 8 x 8, 1e3 m and 1e5 m from the origin, 0.5 s",
    .criterion = "trajectories equal to 1e-9 m",
    .remark =
        "dop853, whose tolerance cannot be below the rounding error of such coordinates (1e-14 of them), may have an error of 1e-8 m; "
        "drawing "
        "relative to the camera is covered by the tests of drawing",
    .judge = judge_large_coordinates,
};

constinit const HardCase islands_case{
    .number = 26,
    .name = "Stiff and soft islands",
    .parameters = "a rope of k = 1e8 N/m and a cloth of k = 1 N/m in one scene, 0.5 s",
    .criterion = "each moves as it does alone, within 1e-6 m; with `auto`, within the tolerance of both runs",
    .slow_under = method_list<dop853>,
    .judge = judge_islands,
};

}  // namespace hooke
