// Invariance: distance from the origin.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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
  // Methods that choose their steps choose others if the last bits differ: equal within the tolerance of both runs, which for dop853 is the
  // rounding error of such coordinates.
  constexpr double automatic_tolerance = 1e-7;
  const bool is_auto = is_automatic(settings);
  if (is_adaptive(method)) settings.tolerance = is_auto ? automatic_tolerance : 1e-12;
  const double limit = is_auto ? 2.0 * seconds * automatic_tolerance : is_adaptive(method) ? 1e-8 : 1e-9;
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
    parts.push_back(judge(run, max < limit, formatted("%.0e m away: error %.1g m", offset, max)));
  }
  return worst_of(parts);
}

}  // namespace

constinit const HardCase large_coordinates_case{
    .number = 23,
    .name = "Large coordinates",
    .parameters = "net of 8 x 8, 1e3 m and 1e5 m from the origin, 0.5 s",
    .criterion = "trajectories equal to 1e-9 m",
    .remark =
        "the tolerance of dop853 cannot be below the rounding error of such coordinates (1e-14 of them): its error may be 1e-8 m, that of "
        "auto at a tolerance of 1e-7 m/s twice as much",
    .judge = judge_large_coordinates,
};

}  // namespace hooke
