// Invariance: refinement of the mesh, distance from the origin, independent parts in one scene.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "formats/scene_file.h"
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

// A sheet of 1 m and 1 kg/m^2, k = 200 N/m and half of that on the diagonals, d = 0.2 N s/m, hung from its top row: its sag and its slowest
// vibration.
struct Sheet {
  double sag = 0.0, period = 0.0, decay = 0.0;  // [m], [s], [1/s]
};

// Mean displacement of row r of n below its position in the undeformed sheet [m].
double drop_of_row(const State& state, int n, int row) {
  double sum = 0.0;
  for (int i = n * row; i < n * (row + 1); ++i) sum += state.position[i].y;
  return -sum / n - static_cast<double>(row) / (n - 1);
}

// Amplitude of the slowest mode: the weight sin(pi s / 2), s from the top row, suppresses the others.
double slowest_mode(const State& state, int n) {
  double sum = 0.0;
  for (int row = 1; row < n; ++row) {
    const double weight = row == n - 1 ? 0.5 : 1.0;
    sum += weight * std::sin(0.5 * std::numbers::pi * row / (n - 1)) * drop_of_row(state, n, row);
  }
  return 2.0 * sum / (n - 1);
}

Sheet measure_sheet(const Integrator& method, int n) {
  const std::string json =
      R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [)" +
      std::to_string(n) + ", " + std::to_string(n) +
      R"(], "density": 1, "stiffness": 200, "shear_stiffness": 100, "damping": 0.2, "nail": ["top"]}]})";
  const Scene scene = parse_scene(json, "sheet").scene;
  TestNetwork network{scene.system, scene.state};
  // at the stability limit, the sweeps over the dashpots of the finest sheet, d h / m = 0.8, would damp 6 % too little
  Settings settings = settings_for(method, network.system, {.free = 4, .fraction = 0.2});

  // brought to rest by drag close to the critical damping of the slowest mode
  TestNetwork hanging = network;
  hanging.system.drag = 50.0;
  MonitoredRun resting(hanging, settings);
  resting.run(1.5);
  Sheet sheet{.sag = drop_of_row(resting.state(), n, n - 1)};

  // without weight it oscillates about the undeformed sheet: the turning points of its slowest mode, over four periods
  network.state.position = resting.state().position;
  network.system.gravity = Vec3(0.0);
  constexpr int frames_per_60th = 4;
  settings.frame_rate *= frames_per_60th;
  settings.substeps = (settings.substeps + frames_per_60th - 1) / frames_per_60th;
  MonitoredRun swinging(network, settings);
  std::vector<double> times, heights;
  double older = 0.0, old = slowest_mode(network.state, n);
  while (times.size() < 9 && swinging.state().time < 2.0 && swinging.frame()) {
    const double now = slowest_mode(swinging.state(), n);
    const double bend = older - 2.0 * old + now;
    if (older != 0.0 && (old - older) * (now - old) <= 0.0 && bend != 0.0) {
      // the vertex of the parabola through the three values
      const double at = 0.5 * (older - now) / bend;
      times.push_back(swinging.state().time + (at - 1.0) / settings.frame_rate);
      heights.push_back(std::abs(old - 0.125 * (now - older) * (now - older) / bend));
    }
    older = old;
    old = now;
  }
  if (times.size() < 9) return sheet;
  sheet.period = (times[8] - times[0]) / 4.0;
  sheet.decay = std::log(heights[0] / heights[8]) / (times[8] - times[0]);
  return sheet;
}

// The case is about the mesh, so one method is sufficient.
Verdict judge_refinement(const Integrator& method) {
  const Sheet finest = measure_sheet(method, 129);
  double sag = 0.0, period = 0.0, decay = 0.0;
  for (const int n : {9, 17, 33, 65}) {
    const Sheet sheet = measure_sheet(method, n);
    sag = std::max(sag, std::abs(sheet.sag / finest.sag - 1.0));
    period = std::max(period, std::abs(sheet.period / finest.period - 1.0));
    decay = std::max(decay, std::abs(sheet.decay / finest.decay - 1.0));
  }
  const bool met = sag < 0.01 && period < 0.01 && decay < 0.05;
  return {.outcome = met ? Outcome::Held : Outcome::FailedSilently,
          .measured = formatted("sag %.4f m, period %.4f s, decay %.3f /s at N = 129; from N = 9 on within %.1g, %.1g and %.1g", finest.sag,
                                finest.period, finest.decay, sag, period, decay)};
}

Verdict judge_large_coordinates(const Integrator& method) {
  constexpr double seconds = 0.5;
  const InitialState net = make_net(8, 1e2, 0.0);
  Settings settings = settings_for(method, net.system, {.min = 20, .free = 20});
  // an adaptive method chooses other steps if the last bits differ: equal within its tolerance
  if (adapts(method)) settings.tolerance = 1e-12;
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
    parts.push_back(judge(run, max < (adapts(method) ? 1e-8 : 1e-9), formatted("%.0e m away: error %.1g m", offset, max)));
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

constinit const HardCase refinement_case{
    .number = 22,
    .name = "Refinement",
    .parameters = "sheet of the same material with 9, 17, 33, 65 and 129 points per side, hung by its top",
    .criterion = "sag and period within 1 %, decay rate within 5 % of the finest",
    .concerns = Concerns::NoMethod,
    .slow = true,
    .judge = judge_refinement,
};

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
