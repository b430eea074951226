// Springs and dashpots far too fast for the frame.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.h"
#include "formats/scene_file.h"
#include "sim/methods/rows.h"
#include "sim/step/divergence.h"
#include "study/analytic_scenes.h"
#include "study/benchmark.h"
#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

constexpr double frame = 1.0 / 60.0;       // [s]
constexpr double energy_round_off = 1e-9;  // of sums of energies

// First order and dissipative: the energy never rises, however the springs rotate.
bool is_dissipative(const Integrator& method) {
  return method.order == 1 && method.energy == EnergyTrend::Falls && method.stability == Stability::LStable && !method.iterates();
}

// 12 x 12 points, 1 m, 1 kg, no gravity; the stiffness k of all springs follows from k dt^2 / m.
TestNetwork make_stiff_sheet(double k_dt2_per_m) {
  constexpr double a = 1.0 / 11.0, m = 1.0 / 144.0;
  const double k = k_dt2_per_m * m / (frame * frame);
  TestNetwork sheet = make_sheet(
      {.rows = 12, .columns = 12, .across = {a, 0.0, 0.0}, .down = {0.0, -a, 0.0}, .mass = m, .stiffness = k, .diagonal_stiffness = k});
  sheet.system.gravity = Vec3(0.0);
  return sheet;
}

Verdict judge_stiff_spring(const Integrator& method) {
  constexpr double k = 3.6e11, rest_length = 1.0, eq = rest_length + 9.81 / k;
  TestNetwork network;
  const PointId point = network.add({0.0, -1.1 * rest_length, 0.0});
  network.join(network.nail(Vec3(0.0)), point, k, rest_length);
  MonitoredRun run(network, {.integrator = &method, .substeps = 1}, {.position = 1e-6 * rest_length});

  // it resolves the exact oscillation in thousands of steps per frame
  if (is_adaptive(method)) {
    run.run(frame);
    if (run.stopped()) return judge(run, false, "");
    return {.outcome = Outcome::OutOfScope, .reason = "resolves the undamped oscillation in thousands of steps per frame"};
  }

  run.run(600 * frame);
  const bool any_step = is_stable_at_any_step(method);
  if (!any_step) return judge(run, Expectation::Report, !run.stopped() || run.state().time >= 59.5 * frame, "not stopped within 60 frames");

  const double off = std::abs(-run.state().position[0].y - eq) / rest_length;
  // without numerical damping it keeps oscillating
  const Expectation expected = method.stability == Stability::AStable ? Expectation::HoldOrReport : Expectation::Hold;
  return judge(run, expected, off <= 1e-6 && run.monitor().energy_rise() <= energy_round_off,
               formatted("%.1g l0 from rest, energy rises %.1g", off, run.monitor().energy_rise()));
}

// A sheet with every point displaced by up to 5 cm in each direction.
TestNetwork make_crumpled_sheet(double k_dt2_per_m, int seed) {
  TestNetwork sheet = make_stiff_sheet(k_dt2_per_m);
  Random random(seed);
  for (Vec3& x : sheet.state.position) x += random.vector(0.05);
  return sheet;
}

constexpr int seeds = 10;

MonitoredRun run_crumpled(const Integrator& method, double k_dt2_per_m, int seed, double seconds) {
  MonitoredRun run(make_crumpled_sheet(k_dt2_per_m, seed), {.integrator = &method, .substeps = 1});
  run.run(seconds);
  return run;
}

std::vector<Verdict> crumple(const Integrator& method, double k_dt2_per_m) {
  if (is_adaptive(method) && k_dt2_per_m > 1e5)
    return {{.outcome = Outcome::OutOfScope, .reason = "resolves the oscillations of these springs in thousands of steps per frame"}};

  // one second of one sheet, and the first frames of nine others
  const MonitoredRun run = run_crumpled(method, k_dt2_per_m, 0, 60 * frame);
  long unconverged = run.monitor().unconverged_solves();
  double rise = run.monitor().energy_rise();
  for (int seed = 1; seed < seeds && !run.stopped(); ++seed) {
    const MonitoredRun start = run_crumpled(method, k_dt2_per_m, seed, 2.0 * frame);
    unconverged += start.monitor().unconverged_solves();
    rise = std::max(rise, start.monitor().energy_rise());
  }

  std::vector<Verdict> parts;
  // methods whose energy can only fall: it falls whether the solves converge or not, because they never end above their starting value
  parts.push_back(judge(run, is_dissipative(method) ? Expectation::Hold : expectation_of(run),
                        rise <= (is_dissipative(method) ? energy_round_off : 0.02),
                        formatted("%.0e: energy rises %.1g", k_dt2_per_m, rise)));
  if (!is_dissipative(method) && unconverged > 0) parts.back().expected = Expectation::HoldOrReport;
  if (unconverged > 0)
    parts.push_back({.outcome = Outcome::FailedOpenly,
                     .expected = Expectation::HoldOrReport,
                     .measured = formatted("%ld solves stopped early", unconverged),
                     .reason = formatted("%ld solves did not converge", unconverged)});
  return parts;
}

Verdict judge_crumpled_sheet(const Integrator& method) {
  std::vector<Verdict> parts;
  for (const double stiffness : {4.0, 4e2, 4e4, 4e6})
    for (Verdict& part : crumple(method, stiffness)) parts.push_back(std::move(part));
  return worst_of(parts);
}

// The border nailed at 0.6 of the rest lengths: every spring is compressed, and every block of the Hessian has negative directions.
Verdict compress(const Integrator& method, double k_dt2_per_m) {
  TestNetwork sheet = make_stiff_sheet(k_dt2_per_m);
  sheet.system.drag = 4.0;
  Random random(7);
  for (int i = 0; i < 144; ++i) {
    const int row = i / 12, column = i % 12;
    const bool border = row == 0 || column == 0 || row == 11 || column == 11;
    sheet.system.point(i).nailed = border;
    sheet.state.position[i] *= 0.6;
    if (!border) sheet.state.position[i].z += random.uniform(-1e-6, 1e-6);
  }

  // other modes than the linear ones are fast too: a third of their limit
  MonitoredRun run(sheet, settings_for(method, sheet.system, {.fraction = 0.3}), {.energy = 1e-3});
  run.run(1.0);
  double highest = 0.0;
  for (const Vec3& x : run.state().position) highest = std::max(highest, std::abs(x.z));
  const double rise = run.monitor().energy_rise();
  const bool must_never_rise = is_dissipative(method) && method.implicit_solve == ImplicitSolve::Iterative;
  const bool solves = run.monitor().unconverged_solves() == 0, never_rises = rise <= (must_never_rise ? energy_round_off : 1e-3);

  // one linear solve overshoots along unconstrained directions, and solves that are stopped early report it
  Expectation expected = expectation_of(run);
  if (method.implicit_solve == ImplicitSolve::Once || (!solves && highest > 0.05 && never_rises)) expected = Expectation::HoldOrReport;
  return judge(run, expected, solves && never_rises && highest > 0.05,
               formatted("%.0e: buckles by %.2f m, energy rises %.1g", k_dt2_per_m, highest, rise));
}

Verdict judge_compressed_sheet(const Integrator& method) { return worst_of(std::array{compress(method, 4.0), compress(method, 4e4)}); }

// Every shipped scene: it finishes or is stopped with a report.
Verdict judge_one_substep(const Integrator& method) {
  int held = 0;
  std::vector<Verdict> parts;
  for (const ShippedScene& shipped : shipped_scenes()) {
    const Scene scene = load_scene(shipped.file).scene;
    MonitoredRun run({scene.system, scene.state}, {.integrator = &method, .substeps = 1});
    run.run(is_adaptive(method) ? 0.05 : 0.25);
    parts.push_back(judge(run, is_finite(run.state()), ""));
    if (parts.back().outcome == Outcome::FailedOpenly) parts.back().reason = shipped.id + ": " + parts.back().reason;
    held += run.stopped() ? 0 : 1;
  }
  if (parts.empty()) throw FileError((assets_folder() / "scenes").string() + ": no scenes found");
  Verdict verdict = worst_of(parts);
  verdict.measured = formatted("%d of %zu scenes finish", held, parts.size());
  return verdict;
}

Verdict judge_huge_damping(const Integrator& method) {
  const InitialState net = make_net(16, 1e4, 1e3);
  const TestNetwork network{net.system, net.state};
  constexpr int substeps = 60;  // stable without the dashpots
  constexpr double seconds = 1.0;

  // the exact dashpots of the default method converge as its steps do
  static const State exact = [&] {
    MonitoredRun reference(network, {.integrator = &default_integrator(), .substeps = 4 * substeps});
    reference.run(seconds);
    return reference.state();
  }();

  const int few = method.stability == Stability::EachSpring ? 4 : 1;
  MonitoredRun run(network, {.integrator = &method, .substeps = is_stable_at_any_step(method) ? few : substeps}, {.position = 1e-4});
  run.run(seconds);

  const double error = rms_distance(run.system(), run.state(), exact);
  // first-order methods are not that accurate at so few steps
  return judge(run, method.order_with.damped == 1 ? Expectation::HoldOrReport : expectation_of(run), error <= 1e-4,
               formatted("error %.1g m after 1 s", error));
}

}  // namespace

constinit const HardCase stiff_spring_case{
    .number = 1,
    .name = "Stiff single spring",
    .parameters = "m = 1 kg, k = 3.6e11 N/m (k dt^2 / m = 1e8), stretched by 10 %, one step per frame, 600 frames",
    .criterion =
        "at most 1e-6 l0 from rest at the end, and the energy never rises; explicit methods must be stopped by the divergence check within "
        "60 frames",
    .remark = "the spring is undamped, so its exact motion never decays: implicit_midpoint, which damps nothing, follows it and fails",
    .judge = judge_stiff_spring,
};

constinit const HardCase crumpled_sheet_case{
    .number = 2,
    .name = "Stiff crumpled sheet",
    .parameters =
        "12 x 12 points, 1 m, 1 kg, each displaced by up to 5 cm, k dt^2 / m = 4, 4e2, 4e4, 4e6, one step per frame; 1 s, and the first "
        "frames with nine other random seeds",
    .criterion = "the energy of implicit_euler and baraff_witkin never rises, that of the others by at most 2 %",
    .remark =
        "a solve is limited to 20 factorizations, and these scenes need more: it stops early, with less energy than it started from, and "
        "is reported; \"never\" means by less than 1e-9 of the energy (baraff_witkin gains up to 3e-10 at 4e6)",
    .slow_under = method_list<dop853, tr_bdf2, esdirk4>,
    .judge = judge_crumpled_sheet,
};

constinit const HardCase compressed_sheet_case{
    .number = 7,
    .name = "Compressed sheet",
    .parameters = "12 x 12 points, border nailed at 0.6 of the rest lengths, drag 4 /s, k dt^2 / m = 4 and 4e4, 1 s",
    .criterion =
        "buckles; the energy never rises under implicit_euler, and by at most 1e-3 of the energy supplied under the others; every solve "
        "converges",
    .remark = "baraff_witkin may fail: its single linear solve overshoots along directions without stiffness",
    .slow_under = method_list<blanes_moan4, runge_kutta4, dop853>,
    .judge = judge_compressed_sheet,
};

constinit const HardCase one_substep_case{
    .number = 10,
    .name = "One substep per frame",
    .parameters = "every shipped scene, one step of 1/60 s per frame, 0.25 s; methods that choose their steps: 0.05 s",
    .criterion = "finite to the end where the method declares that step stable; otherwise the divergence check may stop it",
    .slow_under = method_list<dop853, implicit_euler, baraff_witkin, implicit_midpoint, tr_bdf2, esdirk4>,
    .judge = judge_one_substep,
};

constinit const HardCase huge_damping_case{
    .number = 11,
    .name = "Huge damping",
    .parameters =
        "net of 16 x 16, k = 1e4 N/m, d = 1e3 N s/m (d h / m = 5e4 per frame), 1 s; implicit methods with one substep, xpbd 4, others 60",
    .criterion = "within 1e-4 m of the converged motion",
    .remark = "first-order methods may fail openly at so few steps",
    .slow_under = method_list<dop853>,
    .judge = judge_huge_damping,
};

}  // namespace hooke
