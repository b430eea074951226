// A fast mouse: it drags the corner of a stiff sheet around a circle and releases it.
#include <algorithm>
#include <cmath>

#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

constexpr double a = 1.0 / 23.0;                     // [m], between points
constexpr double speed = 50.0, radius = 1.0;         // [m/s], [m], of the hand
constexpr int held_frames = 30, flight_frames = 90;  // of a 60th

// 24 x 24 points, 1 m, 1 kg, free except for the corner held by the hand.
TestNetwork make_dragged_sheet() {
  TestNetwork sheet =
      make_sheet({.rows = 24, .columns = 24, .across = {a, 0.0, 0.0}, .down = {0.0, -a, 0.0}, .mass = 1.0 / 576.0, .stiffness = 1e6});
  sheet.system.gravity = Vec3(0.0);
  sheet.system.drag = 2.0;
  return sheet;
}

double max_strain(const MonitoredRun& run) {
  double max = 0.0;
  for (const Spring& spring : run.system().springs()) max = std::max(max, std::abs(strain(run.system(), run.state(), spring)));
  return max;
}

// Position of a mouse on the circle: sampled every 1/60 s, with straight lines between.
Vec3 hand_position(double time) {
  const auto mouse_at_frame = [](double frame) {
    const double angle = speed / radius * frame / 60.0;
    return radius * Vec3(std::cos(angle) - 1.0, std::sin(angle), 0.0);
  };
  const double frame = std::floor(60.0 * time + 1e-9), fraction = 60.0 * time - frame;
  return mouse_at_frame(frame) + fraction * (mouse_at_frame(frame + 1.0) - mouse_at_frame(frame));
}

struct Drag {
  double peak_strain = 0.0, last_strain = 0.0;  // [1]
  double gain = 0.0;                            // [1], relative to the energy at the release, which drag only lowers
};

// Samples the strains as often as the substeps allow, up to 16 times in 1/60 s, because waves cross the sheet in a millisecond. Ends early
// at a divergence.
Drag drag_corner(MonitoredRun& run, int samples) {
  Drag drag;
  const Vec3 start = run.state().position[0];
  run.lab().submit(GrabPoint{{.point = run.system().points()[0].id, .kind = GrabKind::Hold, .target = start}});
  for (int i = 1; i <= samples * held_frames; ++i) {
    run.lab().submit(MoveHand{start + hand_position(i / (60.0 * samples))});
    if (!run.frame()) return drag;
    drag.peak_strain = std::max(drag.peak_strain, max_strain(run));
  }

  run.lab().submit(ReleaseHand{});
  const double released = compute_energy(run.system(), run.state()).total();
  for (int i = 0; i < samples * flight_frames && run.frame(); ++i) {
    const double energy = compute_energy(run.system(), run.state()).total();
    drag.gain = std::max(drag.gain, energy / released - 1.0);
    drag.peak_strain = std::max(drag.peak_strain, max_strain(run));
  }
  drag.last_strain = max_strain(run);
  return drag;
}

// Samples per 1/60 s with this number of substeps: each is a separate frame.
int samples_per_frame(int substeps) {
  for (int samples = std::min(16, substeps); samples > 1; --samples)
    if (substeps % samples == 0) return samples;
  return 1;
}

MonitoredRun make_run(const TestNetwork& sheet, const Integrator& method, int substeps, const Tolerance& tolerance) {
  const int samples = samples_per_frame(substeps);
  return {sheet, {.integrator = &method, .frame_rate = 60.0 * samples, .substeps = substeps / samples}, tolerance};
}

// The minimum number of stable substeps, rounded up to a multiple of 16 for sampling.
int stable_substeps(const Integrator& method, const TestNetwork& sheet, double fraction) {
  return (settings_for(method, sheet.system, {.fraction = fraction}).substeps + 15) / 16 * 16;
}

// The largest strain of the converged drag: of the default method at a quarter of its limit.
double converged_peak() {
  static const double peak = [] {
    const TestNetwork sheet = make_dragged_sheet();
    MonitoredRun run = make_run(sheet, default_integrator(), stable_substeps(default_integrator(), sheet, 0.25), {});
    return drag_corner(run, 16).peak_strain;
  }();
  return peak;
}

// The same above a slab of 2 cm, far thinner than the 0.8 m per frame, into which the sheet swings: the number of points that pass through.
int count_through_slab(const Integrator& method, int substeps) {
  constexpr double top = -1.2 * radius, thickness = 0.02, wide = 1e3;
  TestNetwork sheet = make_dragged_sheet();
  for (Vec3& x : sheet.state.position) x.y += 1.0;
  sheet.system.colliders.push_back({.shape = Box{{-wide, top - thickness, -wide}, {wide, top, wide}}, .restitution = 0.3, .friction = 0.3});
  MonitoredRun run(sheet, {.integrator = &method, .substeps = substeps});
  drag_corner(run, 1);
  return static_cast<int>(std::ranges::count_if(run.state().position, [](const Vec3& x) { return x.y < top - 1e-9; }));
}

std::vector<int> substeps_of(const Integrator& method, const TestNetwork& sheet) {
  if (method.stability == Stability::EachSpring && !method.iterates) return {16, 64, 256, 1024};
  if (is_stable_at_any_step(method)) {
    // production methods are refined until they are accurate
    if (!method.for_production || method.order == 2) return {1, 4};
    return method.order == 1 ? std::vector{1, 4, 16, 64} : std::vector{1, 4, 64};
  }
  if (is_adaptive(method)) return {16};
  const int fewest = stable_substeps(method, sheet, 1.0);
  return {fewest, 2 * fewest};
}

bool is_met(const Drag& drag) {
  const double peak = converged_peak();
  return drag.peak_strain <= 2.0 * peak && drag.peak_strain >= 0.5 * peak && drag.gain <= 1e-2;
}

// A method at one step size.
struct StepTrial {
  int substeps = 0;
  Verdict verdict;
  bool holds() const { return verdict.outcome == Outcome::Held; }
};
StepTrial run_step_trial(const Integrator& method, const TestNetwork& sheet, int substeps, bool is_finest) {
  MonitoredRun run = make_run(sheet, method, substeps, {.position = 0.5 * converged_peak() * a});
  const Drag drag = drag_corner(run, samples_per_frame(substeps));
  // a method stable at any step need not be accurate with few steps, nor a first-order method near its limit
  const bool must_hold = is_finest && method.for_production, may_fail = is_stable_at_any_step(method) || method.order == 1;
  const Expectation expected = must_hold ? Expectation::Hold : may_fail ? Expectation::HoldOrReport : expectation_of(run);
  return {substeps, judge(run, expected, is_met(drag),
                          formatted("%d substeps: peak strain %.2g, last %.1g, energy gained after release %.1g", substeps,
                                    drag.peak_strain, drag.last_strain, drag.gain))};
}

// A method is judged by its finest step, provided that coarser steps fail openly; the result states from which step on it succeeds.
Verdict judge_step_trials(std::span<const StepTrial> step_trials) {
  std::vector<Verdict> parts;
  for (const StepTrial& step_trial : step_trials)
    if (step_trial.holds() || is_broken(step_trial.verdict) || &step_trial == &step_trials.back()) parts.push_back(step_trial.verdict);
  Verdict verdict = worst_of(parts);
  if (!step_trials.back().holds()) return verdict;

  std::size_t first = step_trials.size();
  while (first > 0 && step_trials[first - 1].holds()) --first;
  std::string coarser;
  for (const StepTrial& step_trial : step_trials.first(first))
    coarser += (coarser.empty() ? "" : ", ") + std::to_string(step_trial.substeps);
  if (!coarser.empty())
    verdict.measured =
        formatted("from %d substeps on; fails openly with ", step_trials[first].substeps) + coarser + ": " + verdict.measured;
  return verdict;
}

Verdict judge_fast_drag(const Integrator& method) {
  const TestNetwork sheet = make_dragged_sheet();
  const std::vector<int> substep_counts = substeps_of(method, sheet);
  std::vector<StepTrial> step_trials;
  for (const int substeps : substep_counts)
    step_trials.push_back(run_step_trial(method, sheet, substeps, substeps == substep_counts.back()));

  std::vector<Verdict> parts;
  if (method.for_production) {
    parts.push_back(judge_step_trials(step_trials));
  } else {
    for (const StepTrial& step_trial : step_trials) parts.push_back(step_trial.verdict);
  }
  // no tunneling at any step
  const int through = count_through_slab(method, is_stable_at_any_step(method) ? 1 : substep_counts[0]);
  parts.push_back(
      {.outcome = through == 0 ? Outcome::Held : Outcome::FailedSilently, .measured = formatted("%d points through the slab", through)});
  return worst_of(parts);
}

}  // namespace

constinit const HardCase fast_drag_case{
    .number = 8,
    .name = "Fast drag",
    .parameters =
        "24 x 24 points, 1 m, 1 kg, k = 1e6 N/m, no gravity, free except for a corner that is dragged around a circle of 1 m at 50 m/s for "
        "0.5 s, sampled 60 times per second with straight lines between, drag 2 /s; then 1.5 s of free flight; and the same above a slab "
        "of "
        "2 cm",
    .criterion =
        "peak strain within a factor of 2 of the converged one, never more energy than at release (1e-2), no point through the slab",
    .remark =
        "production methods must succeed at the finest step tried and are judged by it; the result states from which step on they succeed, "
        "and coarser steps must fail openly; the energy of a step at the stability limit is known to 1e-2 at best",
    .slow = true,
    .judge = judge_fast_drag,
};

}  // namespace hooke
