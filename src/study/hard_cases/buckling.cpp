// Buckling: scenes that leave an unstable equilibrium.
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/methods/rows.h"
#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

// Two bars from (+-1, 0) to an apex at (0, h), h = 0.1, under 1.5 times the critical load: P(y) = k y (h^2 - y^2), y the remaining height,
// has its maximum at y = h / sqrt(3) (shallow truss; R. von Mises 1923).
constexpr double bar_stiffness = 1e4, truss_rise = 0.1;  // [N/m], [m]

// The rest position of the apex under the load P, far below the nails: the root of 2 k (L - L0) y / L = P.
double hanging_rest(double load) {
  const double rest_length = std::hypot(1.0, truss_rise);
  double min = truss_rise, max = 2.0;
  for (int i = 0; i < 60; ++i) {
    const double y = 0.5 * (min + max), length = std::hypot(1.0, y);
    (2.0 * bar_stiffness * (length - rest_length) * y / length < load ? min : max) = y;
  }
  return -min;
}

struct Snap {
  double rest = 0.0;  // [m], height at the end
  Verdict verdict;
};
Snap snap_through(const Integrator& method, int refinement) {
  const double limit = bar_stiffness * truss_rise * truss_rise * truss_rise * 2.0 / (3.0 * std::sqrt(3.0));
  const double mass = 1.5 * limit / 9.81;
  TestNetwork network;
  network.system.drag = 8.0;
  const PointId apex = network.add({0.0, truss_rise, 0.0}, mass);
  for (const double side : {-1.0, 1.0}) network.join(network.nail({side, 0.0, 0.0}), apex, bar_stiffness);

  // one step per frame for methods stable at any step, else half the largest step
  Settings settings = settings_for(method, network.system, {.fraction = 0.5});
  settings.substeps *= refinement;
  MonitoredRun run(network, settings, {.energy = 1e-3, .position = 1e-3 * truss_rise});
  run.run(5.0);
  const double rest = run.state().position[0].y, off = std::abs(rest - hanging_rest(mass * 9.81));
  const double energy_rise = run.monitor().energy_rise(), allowed = method.energy == EnergyTrend::Falls ? 1e-9 : 1e-3;
  return {rest, judge(run, off < 1e-4 && energy_rise < allowed && run.monitor().unconverged_solves() == 0,
                      formatted("at rest at %.3f m with an error of %.1g m, energy rises %.1g", rest, off, energy_rise))};
}

Verdict judge_snap_through(const Integrator& method) {
  const Snap coarse = snap_through(method, 1), fine = snap_through(method, 2);
  Verdict verdict = worst_of(std::array{coarse.verdict, fine.verdict});
  // half the step must not lead to the other branch
  if (verdict.outcome == Outcome::Held && std::abs(coarse.rest - fine.rest) > 1e-4) verdict.outcome = Outcome::FailedSilently;
  return verdict;
}

Verdict judge_tangled_start(const Integrator& method) {
  constexpr int n = 6;
  TestNetwork sheet = make_sheet({.rows = n,
                                  .columns = n,
                                  .across = {0.2, 0.0, 0.0},
                                  .down = {0.0, -0.2, 0.0},
                                  .mass = 1.0 / 36.0,
                                  .stiffness = 100.0,
                                  .diagonal_stiffness = 50.0});
  sheet.system.gravity = Vec3(0.0);
  sheet.system.drag = 2.0;
  Random random(18);
  for (int i = n * n - 1; i > 0; --i) std::swap(sheet.state.position[i], sheet.state.position[random.next_bits() % (i + 1)]);
  for (Vec3& x : sheet.state.position) x += random.vector(1e-3);

  MonitoredRun run(sheet, settings_for(method, sheet.system, {.min = 4}), {.position = 1e-3 * 0.2});
  run.run(60.0);
  double max = 0.0;
  for (const Spring& spring : run.system().springs()) max = std::max(max, std::abs(strain(run.system(), run.state(), spring)));
  return judge(run, max < 1e-3, formatted("strain %.1g at rest", max));
}

}  // namespace

constinit const HardCase snap_through_case{
    .number = 16,
    .name = "Snap-through",
    .parameters =
        "von Mises truss, rise 0.1, 1.5 times its critical load, drag 8 /s, 5 s; one step per frame for methods stable at any step, and "
        "half of it",
    .criterion =
        "snaps through and comes to rest within 1e-4 m of the exact position at both steps; every solve converges; the energy never rises "
        "(1e-9 for dissipative methods, else 1e-3)",
    .judge = judge_snap_through,
};

constinit const HardCase tangled_start_case{
    .number = 18,
    .name = "Tangled start",
    .parameters = "sheet of 6 x 6 with its points permuted at random, drag 2 /s, 60 s",
    .criterion = "finite, and back to a strain < 1e-3 at rest",
    .slow_under = method_list<explicit_euler>,
    .judge = judge_tangled_start,
};

}  // namespace hooke
