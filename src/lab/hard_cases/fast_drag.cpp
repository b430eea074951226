// A mouse that is too fast: it drags the corner of a stiff sheet round a circle and lets go.
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>

#include "lab/hard_cases/rows.h"
#include "lab/hard_cases/watched_run.h"

namespace hooke {
namespace {

constexpr double a = 1.0 / 23.0;                     // [m], between points
constexpr double speed = 50.0, radius = 1.0;         // [m/s], [m], of the hand
constexpr double top_speed = 10.0;                   // [m/s], where the hand is held to one
constexpr int held_frames = 30, flight_frames = 90;  // of a 60th

// 24 x 24 points, 1 m, 1 kg, free but for the hand at a corner.
Draft make_dragged_sheet() {
  Draft sheet =
      make_sheet({.rows = 24, .columns = 24, .across = {a, 0.0, 0.0}, .down = {0.0, -a, 0.0}, .mass = 1.0 / 576.0, .stiffness = 1e6});
  sheet.system.gravity = Vec3(0.0);
  sheet.system.drag = 2.0;
  return sheet;
}

double most_strain(const WatchedRun& run) {
  double most = 0.0;
  for (const Spring& spring : run.system().springs()) most = std::max(most, std::abs(strain(run.system(), run.state(), spring)));
  return most;
}

// Where a mouse is seen that goes round the circle: at every 60th of a second, and straight ahead between.
Vec3 hand_at(double time) {
  const auto seen = [](double frame) {
    const double angle = speed / radius * frame / 60.0;
    return radius * Vec3(std::cos(angle) - 1.0, std::sin(angle), 0.0);
  };
  const double frame = std::floor(60.0 * time + 1e-9), share = 60.0 * time - frame;
  return seen(frame) + share * (seen(frame + 1.0) - seen(frame));
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Drag {
  double peak_strain = 0.0, last_strain = 0.0;  // [1]
  double gain = 0.0;                            // [1], above the energy at the release, of that: drag alone takes some
  double ms_per_frame = 0.0;                    // [ms] of CPU a 60th of a second
};

// Looks at the strains as often as the substeps allow, up to 16 times in a 60th of a second: waves cross the sheet in a
// millisecond. The watch ends it early.
Drag drag_corner(WatchedRun& run, int looks) {
  Drag drag;
  double busy = 0.0;
  const auto frame = [&] {
    const double start = thread_seconds();
    const bool held = run.frame();
    busy += thread_seconds() - start;
    return held;
  };

  const Vec3 start = run.state().position[0];
  run.lab().submit(GrabPoint{{.point = run.system().points()[0].id, .kind = GrabKind::Hold, .target = start}});
  for (int i = 1; i <= looks * held_frames; ++i) {
    run.lab().submit(MoveHand{start + hand_at(i / (60.0 * looks))});
    if (!frame()) return drag;
    drag.peak_strain = std::max(drag.peak_strain, most_strain(run));
  }

  run.lab().submit(ReleaseHand{});
  const double released = compute_energy(run.system(), run.state()).total();
  for (int i = 0; i < looks * flight_frames && frame(); ++i) {
    const double energy = compute_energy(run.system(), run.state()).total();
    drag.gain = std::max(drag.gain, energy / released - 1.0);
    drag.peak_strain = std::max(drag.peak_strain, most_strain(run));
  }
  drag.last_strain = most_strain(run);
  drag.ms_per_frame = 1e3 * busy / (held_frames + flight_frames);
  return drag;
}

// Of `substeps` a 60th: as many frames of their own as there may be looks.
int looks_of(int substeps) {
  for (int looks = std::min(16, substeps); looks > 1; --looks)
    if (substeps % looks == 0) return looks;
  return 1;
}

WatchedRun make_run(const Draft& sheet, const Integrator& method, int substeps, const Tolerance& tolerance) {
  const int looks = looks_of(substeps);
  return {sheet, {.integrator = &method, .frame_rate = 60.0 * looks, .substeps = substeps / looks}, tolerance};
}

// A sixteenth more than the fewest stable substeps at most: to be looked at often.
int stable_substeps(const Integrator& method, const Draft& sheet, double share) {
  return (settings_for(method, sheet.system, {.share = share}).substeps + 15) / 16 * 16;
}

// The converged drag: the default method at a quarter of its limit.
struct Converged {
  int substeps;
  Drag drag;
};
const Converged& converged() {
  static const Converged reference = [] {
    const Draft sheet = make_dragged_sheet();
    const int substeps = stable_substeps(default_integrator(), sheet, 0.25);
    WatchedRun run = make_run(sheet, default_integrator(), substeps, {});
    return Converged{substeps, drag_corner(run, 16)};
  }();
  return reference;
}

// Its cost is the least of three runs, where they take no longer than a second.
Drag drag_again(const Draft& sheet, const Integrator& method, int substeps, Drag drag) {
  constexpr double patience = 1e3 / (held_frames + flight_frames);  // [ms] a frame
  for (int i = 1; i < 3 && drag.ms_per_frame < patience; ++i) {
    WatchedRun run = make_run(sheet, method, substeps, {});
    drag.ms_per_frame = std::min(drag.ms_per_frame, drag_corner(run, looks_of(substeps)).ms_per_frame);
  }
  return drag;
}

std::vector<std::string> row_of(const std::string& substeps, const Drag& drag, const std::string& report) {
  return {substeps,
          text("%.2g", drag.peak_strain),
          text("%.2g", drag.peak_strain / converged().drag.peak_strain),
          text("%.1g", drag.last_strain),
          text("%.1g", drag.gain),
          text("%.2g", drag.ms_per_frame),
          report};
}

// The same over a slab of 2 cm, far too thin for 0.8 m a frame, that the sheet is swung into: how many points get through.
int count_through_slab(const Integrator& method, int substeps) {
  constexpr double top = -1.2 * radius, thickness = 0.02, wide = 1e3;
  Draft sheet = make_dragged_sheet();
  for (Vec3& x : sheet.state.position) x.y += 1.0;
  sheet.system.colliders.push_back({.shape = Box{{-wide, top - thickness, -wide}, {wide, top, wide}}, .restitution = 0.3, .friction = 0.3});
  WatchedRun run(sheet, {.integrator = &method, .substeps = substeps});
  drag_corner(run, 1);
  return static_cast<int>(std::ranges::count_if(run.state().position, [](const Vec3& x) { return x.y < top - 1e-9; }));
}

// Methods that a scene may be left to: at the finest of their steps here each has to hold.
bool is_for_production(const Integrator& method) {
  constexpr std::array<std::string_view, 8> ids{"velocity_verlet", "blanes_moan4", "runge_kutta4", "dop853", "xpbd",
                                                "implicit_euler",  "tr_bdf2",      "esdirk4"};
  return std::ranges::find(ids, method.id) != ids.end();
}

std::vector<int> substeps_of(const Integrator& method, const Draft& sheet) {
  if (method.stability == Stability::EachSpring) return {16, 64, 256, 1024};
  if (method.id == "implicit_euler") return {1, 4, 16, 64};
  if (method.id == "esdirk4") return {1, 4, 64};
  if (takes_any_step(method)) return {1, 4};
  if (adapts(method)) return {16};
  const int fewest = stable_substeps(method, sheet, 1.0);
  return {fewest, 2 * fewest};
}

bool is_met(const Drag& drag) {
  const double peak = converged().drag.peak_strain;
  return drag.peak_strain <= 2.0 * peak && drag.peak_strain >= 0.5 * peak && drag.gain <= 1e-2;
}

// One step of a method: its verdict, and its row in the table.
struct Rung {
  int substeps = 0;
  Verdict verdict;
  std::vector<std::string> row;
  bool holds() const { return verdict.outcome == Outcome::Held; }
};
Rung climb(const Integrator& method, const Draft& sheet, int substeps, bool is_finest) {
  WatchedRun run = make_run(sheet, method, substeps, {.position = 0.5 * converged().drag.peak_strain * a});
  Drag drag = drag_corner(run, looks_of(substeps));
  const std::string name = text("%d", substeps);
  Rung rung{.substeps = substeps};
  if (run.stopped())
    rung.row = {name, "stopped", "", "", "", "", run.report()};
  else
    rung.row = row_of(name, drag_again(sheet, method, substeps, drag), is_met(drag) ? "" : run.report());

  // one that holds at any step need not be exact at few, nor one of first order near its limit
  const bool must_hold = is_finest && is_for_production(method), may_fail = takes_any_step(method) || method.order == 1;
  const Expectation expected = must_hold ? Expectation::Hold : may_fail ? Expectation::HoldOrReport : expectation_of(run);
  rung.verdict = judge(run, expected, is_met(drag),
                       text("%d substeps: peak strain %.2g, last %.1g, energy gained after release %.1g", substeps, drag.peak_strain,
                            drag.last_strain, drag.gain));
  return rung;
}

// A method is judged by its finest step, when the coarser ones fail openly at worst; and says from which step on it holds.
Verdict judge_ladder(std::span<const Rung> rungs) {
  std::vector<Verdict> parts;
  for (const Rung& rung : rungs)
    if (rung.holds() || is_broken(rung.verdict) || &rung == &rungs.back()) parts.push_back(rung.verdict);
  Verdict verdict = worst_of(parts);
  if (!rungs.back().holds()) return verdict;

  std::size_t first = rungs.size();
  while (first > 0 && rungs[first - 1].holds()) --first;
  std::string coarser;
  for (const Rung& rung : rungs.first(first)) coarser += (coarser.empty() ? "" : ", ") + std::to_string(rung.substeps);
  if (!coarser.empty())
    verdict.measured = text("from %d substeps on, openly not with ", rungs[first].substeps) + coarser + ": " + verdict.measured;
  return verdict;
}

// The same mouse, but the hand is held to a top speed: it stays behind, says by how much, and the sheet is stretched the less.
Verdict judge_lag(const Integrator& method, int substeps) {
  Draft sheet = make_dragged_sheet();
  sheet.system.hand_speed = top_speed;
  WatchedRun run = make_run(sheet, method, substeps, {});
  const int looks = looks_of(substeps);
  const Vec3 start = run.state().position[0];
  double fastest = 0.0, lag = 0.0, most = 0.0;
  bool is_said = true;
  run.lab().submit(GrabPoint{{.point = run.system().points()[0].id, .kind = GrabKind::Hold, .target = start}});
  for (int i = 1; i <= looks * held_frames; ++i) {
    const Vec3 before = run.state().position[0], target = start + hand_at(i / (60.0 * looks));
    run.lab().submit(MoveHand{target});
    if (!run.frame()) break;
    run.lab().publish();
    const double behind = glm::distance(target, run.state().position[0]);
    is_said = is_said && std::abs(run.lab().status()->hand_lag - behind) < 1e-9;
    fastest = std::max(fastest, glm::distance(run.state().position[0], before) * 60.0 * looks);
    lag = std::max(lag, behind);
    most = std::max(most, most_strain(run));
  }
  const bool is_met = !run.stopped() && is_said && fastest < top_speed * (1.0 + 1e-9) && most < converged().drag.peak_strain;
  return judge(run, Expectation::Hold, is_met,
               text("at most %.0f m/s: the hand is up to %.2g m behind, and says so; peak strain %.2g", top_speed, lag, most));
}

}  // namespace

Verdict judge_fast_drag(const Integrator& method) {
  const Draft sheet = make_dragged_sheet();
  const std::vector<int> ladder = substeps_of(method, sheet);
  std::vector<Rung> rungs;
  for (const int substeps : ladder) rungs.push_back(climb(method, sheet, substeps, substeps == ladder.back()));

  std::vector<Verdict> parts;
  if (is_for_production(method)) {
    parts.push_back(judge_ladder(rungs));
  } else {
    for (const Rung& rung : rungs) parts.push_back(rung.verdict);
  }
  // nothing tunnels, at whatever step
  const int through = count_through_slab(method, takes_any_step(method) ? 1 : ladder[0]);
  parts.push_back(
      {.outcome = through == 0 ? Outcome::Held : Outcome::FailedSilently, .measured = text("%d points through the slab", through)});
  if (&method == &default_integrator()) parts.push_back(judge_lag(method, ladder[0]));

  Verdict verdict = worst_of(parts);
  for (Rung& rung : rungs) verdict.rows.push_back(std::move(rung.row));
  if (&method == &default_integrator())
    verdict.rows.push_back(row_of(text("%d, the converged", converged().substeps), converged().drag, ""));
  return verdict;
}

}  // namespace hooke
