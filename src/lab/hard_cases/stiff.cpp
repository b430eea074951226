// Springs and dashpots far too fast for the frame.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "lab/course.h"
#include "lab/hard_cases/rows.h"
#include "lab/hard_cases/watched_run.h"
#include "lab/scene_nets.h"

namespace hooke {
namespace {

constexpr double frame = 1.0 / 60.0;  // [s]
constexpr double round_off = 1e-9;    // of the sums that energies are

bool adapts(const Integrator& method) { return method.stability == Stability::Adaptive; }

// 12 x 12 points, 1 m, 1 kg, all springs of the stiffness k that k dt^2 / m asks for; no gravity.
Draft make_stiff_sheet(double k_dt2_per_m) {
  constexpr double a = 1.0 / 11.0, m = 1.0 / 144.0;
  const double k = k_dt2_per_m * m / (frame * frame);
  Draft sheet = make_sheet({.rows = 12,
                            .columns = 12,
                            .across = {a, 0.0, 0.0},
                            .down = {0.0, -a, 0.0},
                            .mass = m,
                            .stiffness = k,
                            .diagonal_stiffness = k});
  sheet.system.gravity = Vec3(0.0);
  return sheet;
}

}  // namespace

Verdict judge_stiff_spring(const Integrator& method) {
  constexpr double k = 3.6e11, rest_length = 1.0;
  Draft draft;
  const PointId point = draft.add({0.0, -1.1 * rest_length, 0.0});
  draft.join(draft.nail(Vec3(0.0)), point, k, rest_length);
  WatchedRun run(draft, {.integrator = &method, .substeps = 1});

  // who adapts its step would need some 1e7 of them, and shows the same in a tenth of a second
  run.run(adapts(method) ? 0.1 : 10.0);
  if (run.stopped() && run.state().time < 1.0) return judge(run, Expectation::Report, false, "");

  // the spring is undamped: only a method for stiff scenes takes its motion out
  const double off = std::abs(-run.state().position[0].y - (rest_length + 9.81 / k)) / rest_length;
  const double allowed = method.stability == Stability::Stiff ? 1e-6 : 0.1 * (1.0 + 1e-6);
  return judge(run, off <= allowed && run.energy_rise() <= round_off, text("off rest %.1g l0, energy rises %.1g", off, run.energy_rise()));
}

namespace {

// A sheet with every point out of place by up to 5 cm in each direction.
WatchedRun run_crumpled(const Integrator& method, double k_dt2_per_m, int seed, double seconds) {
  Draft sheet = make_stiff_sheet(k_dt2_per_m);
  Dice dice(seed);
  for (Vec3& x : sheet.state.position) x += dice.vector(0.05);
  WatchedRun run(sheet, {.integrator = &method, .substeps = 1});
  run.run(seconds);
  return run;
}

Verdict crumple(const Integrator& method, double k_dt2_per_m) {
  if (adapts(method) && k_dt2_per_m > 1e3)
    return {.outcome = Outcome::OutOfScope, .reason = "steps as short as these springs ask for would take hours"};

  // a second of it, and the first frames of nine others
  constexpr int seeds = 10;
  const WatchedRun run = run_crumpled(method, k_dt2_per_m, 0, 1.0);
  int converged = run.all_solves_converged() ? 1 : 0;
  for (int seed = 1; seed < seeds && !run.stopped(); ++seed)
    converged += run_crumpled(method, k_dt2_per_m, seed, 2.0 * frame).all_solves_converged() ? 1 : 0;

  const bool rises = method.energy == EnergyTrend::Falls && run.energy_rise() > round_off;
  return judge(run, converged == seeds && !rises,
               text("%.0e: energy rises %.1g, %d of %d converge", k_dt2_per_m, run.energy_rise(), converged, seeds), {.position = 0.01});
}

}  // namespace

Verdict judge_crumpled_sheet(const Integrator& method) {
  return worst_of(std::array{crumple(method, 4.0), crumple(method, 4e2), crumple(method, 4e4), crumple(method, 4e6)});
}

namespace {

// The border nailed at 0.6 of the rest lengths: every spring pushes, every block of the Hessian has negative directions.
Verdict compress(const Integrator& method, double k_dt2_per_m) {
  Draft sheet = make_stiff_sheet(k_dt2_per_m);
  sheet.system.drag = 4.0;
  Dice dice(7);
  for (int i = 0; i < 144; ++i) {
    const int row = i / 12, column = i % 12;
    const bool border = row == 0 || column == 0 || row == 11 || column == 11;
    sheet.system.point(i).nailed = border;
    sheet.state.position[i] *= 0.6;
    if (!border) sheet.state.position[i].z += dice.between(-1e-6, 1e-6);
  }

  // modes beside the linear ones are fast too: a third of the limit of these
  WatchedRun run(sheet, settings_for(method, sheet.system, {.share = 0.3}));
  run.run(1.0);
  double highest = 0.0;
  for (const Vec3& x : run.state().position) highest = std::max(highest, std::abs(x.z));
  return judge(run, run.energy_rise() <= 1e-3 && highest > 0.05 && run.all_solves_converged(),
               text("%.0e: buckles by %.2f m, energy rises %.1g", k_dt2_per_m, highest, run.energy_rise()), {.position = 0.01});
}

}  // namespace

Verdict judge_compressed_sheet(const Integrator& method) { return worst_of(std::array{compress(method, 4.0), compress(method, 4e4)}); }

Verdict judge_huge_damping(const Integrator& method) {
  const Start net = make_net(16, 1e4, 1e3);
  const Draft draft{net.system, net.state};

  // the exact dashpots of the default method converge as its steps do
  constexpr int substeps = 60;  // stable without the dashpots
  WatchedRun reference(draft, {.integrator = &default_integrator(), .substeps = 16 * substeps});
  WatchedRun run(draft, {.integrator = &method, .substeps = takes_any_step(method) ? 1 : substeps});
  reference.run(1.0);
  run.run(1.0);

  const double error = rms_distance(run.state(), reference.state());
  return judge(run, error <= 1e-4, text("error %.1g m after 1 s", error), {.position = 1e-4});
}

}  // namespace hooke
