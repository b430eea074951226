// Compares Hooke with other engines: peers_bench FOLDER writes peers.svg, peers.json, peers.md (error against CPU time) and costs.md
// (dashpots and contact next to the simplest case, and a cloth in its own folds). Used by scripts/peers.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <glm/geometric.hpp>

#include "base/atomic_write.h"
#include "base/formatted.h"
#include "batch/machine.h"
#include "peers/peer.h"
#include "peers/peer_problems.h"
#include "peers/peer_sweep.h"
#include "sim/plan/plan.h"
#include "study/work_precision_chart.h"
#include "study/work_precision_file.h"
#include "support/crossings.h"

namespace hooke {
namespace {

constexpr Effort peer_effort{.repeats = 3, .run_seconds = 0.6, .reference_seconds = 3.0, .finest_error = 1e-10};

void note(const std::string& text) {
  std::fputs((text + "\n").c_str(), stderr);
  std::fflush(stderr);
}

// The methods of Hooke beside the other engines.
std::vector<const Integrator*> methods_beside() {
  std::vector<const Integrator*> methods;
  for (const char* id : {"velocity_verlet", "blanes_moan4", "xpbd", "tr_bdf2"}) methods.push_back(find_integrator(id));
  return methods;
}

double stable_step(const Problem& problem, const Integrator& method) {
  const double step = largest_stable_step(method, bound_spectrum(problem.system));
  return std::isfinite(step) ? step : 0.0;
}

double stable_step(const Problem& problem, const PeerKind& kind) {
  return 0.5 * kind.limit * stable_step(problem, *find_integrator(kind.is_damped_apart ? "velocity_verlet" : "symplectic_euler"));
}

ProblemRecord compare_on(const Problem& problem, std::vector<std::string>& obstacles) {
  ProblemRecord record = make_record(problem);
  Benchmark benchmark(problem);
  // two runs of each of two methods: on the largest cloth they take longer
  const double seconds = (problem.system.spring_count() > 50'000 ? 3.0 : 1.0) * peer_effort.reference_seconds;
  const ReferenceResult found = compute_reference(benchmark, seconds, [] { return true; });
  if (!found.reference) {
    note(problem.id + ": no reference, nothing measured: " + found.reason);
    return record;
  }
  const Reference& reference = *found.reference;
  record.reference = ReferenceRecord{.method = std::string(reference.own.method->id),
                                     .setting = reference.own.setting_name,
                                     .other_method = std::string(reference.other.method->id),
                                     .other_setting = reference.other.setting_name,
                                     .own_gap = reference.own.gap,
                                     .other_own_gap = reference.other.gap,
                                     .other_gap = reference.other_gap,
                                     .amplification = reference.amplification,
                                     .measure = reference.measure};
  for (const Integrator* method : methods_beside()) {
    note(problem.id + "  " + std::string(method->id));
    const std::unique_ptr<Peer> peer = load_method(problem, *method);
    sweep_peer({.id = std::string(method->id), .first_step = stable_step(problem, *method)}, *peer, problem, reference, peer_effort,
               record);
  }
  for (const PeerKind* kind : other_engines()) {
    const std::string obstacle = kind->obstacle(problem);
    note(problem.id + "  " + kind->id + (obstacle.empty() ? "" : ": not measured: " + obstacle));
    obstacles.push_back(obstacle);
    if (!obstacle.empty()) continue;
    const std::unique_ptr<Peer> peer = kind->load(problem);
    sweep_peer({.id = kind->id, .first_step = stable_step(problem, *kind), .iterations = kind->iterations}, *peer, problem, reference,
               peer_effort, record);
  }
  return record;
}

std::string cost_for(const ProblemRecord& record, const std::string& id, double error) {
  const Row* best = nullptr;
  for (const Row& row : record.rows)
    if (row.method == id && *row.relative_error <= error && (best == nullptr || *row.cpu_ms_per_s < *best->cpu_ms_per_s)) best = &row;
  return best == nullptr ? "-" : formatted("%.3g", *best->cpu_ms_per_s);
}

std::string min_error(const ProblemRecord& record, const std::string& id) {
  double min = INFINITY;
  for (const Row& row : record.rows)
    if (row.method == id) min = std::min(min, *row.relative_error);
  return formatted("%.0e", min);
}

std::string table_of(const ProblemRecord& record, const std::vector<std::string>& obstacles) {
  std::string text = formatted("\n### %s: %s\n\n%d points, %d springs, %g s; ", record.id.c_str(), record.title.c_str(), record.points,
                               record.springs, record.seconds);
  if (!record.reference) return text + "no reference, nothing measured.\n";
  append_formatted(text, "the reference is accurate to %.0e.\n\n", record.reference->uncertainty());
  text +=
      "| engine | ns per spring and step | 1e-2 | 1e-3 | 1e-4 | 1e-6 | 1e-8 | smallest error measured "
      "|\n|---|---|---|---|---|---|---|---|\n";
  const auto add = [&](const std::string& id) {
    const double step = step_seconds_per_spring(record, id);
    append_formatted(text, "| `%s` | ", id.c_str());
    if (step == 0.0) {
      text += "no stable setting within the time limit | | | | | | |\n";
      return;
    }
    append_formatted(text, "%.3g", 1e9 * step);
    for (const double error : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8}) text += " | " + cost_for(record, id, error);
    text += " | " + min_error(record, id) + " |\n";
  };
  for (const Integrator* method : methods_beside()) add(std::string(method->id));
  std::size_t i = 0;
  for (const PeerKind* kind : other_engines()) {
    const std::string& obstacle = obstacles[i++];
    if (obstacle.empty())
      add(kind->id);
    else
      text += "| `" + kind->id + "` | not measured (" + obstacle + ") | | | | | | |\n";
  }
  return text;
}

// How far points are inside the colliders [m], less their radius.
double penetration(const Problem& problem, const State& state) {
  double max = 0.0;
  for (const Collider& collider : problem.system.colliders)
    for (Index i = 0; i < problem.system.point_count(); ++i) {
      const Vec3& x = state.position[i];
      const Sphere* ball = std::get_if<Sphere>(&collider.shape);
      const Plane* plane = std::get_if<Plane>(&collider.shape);
      const double distance = ball != nullptr ? glm::distance(x, ball->center) - ball->radius : glm::dot(plane->normal, x - plane->point);
      max = std::max(max, problem.system.points()[i].radius - distance);
    }
  return max;
}

// ns per spring and step of the last part of a run.
std::string last_cost(const Problem& problem, const PeerSetting& setting, const PeerRun& run) {
  return formatted("%.3g", 1e9 * run.cpu_seconds.back() / setting.steps / problem.system.spring_count());
}

std::string feature_row(const std::string& label, const std::function<std::unique_ptr<Peer>(const Problem&)>& load,
                        const std::function<std::string(const Problem&)>& obstacle) {
  const Problem alone = peer_cloth(32, 0.2), damped = with_dashpots(alone, 0.001), falling = cloth_on_ball_and_floor(32, 1.1);
  std::string text = "| " + label;
  for (const Problem* problem : {&alone, &damped, &falling}) {
    const bool falls = problem == &falling;
    const PeerSetting setting{.snapshots = falls ? 11 : 4,
                              .steps = static_cast<int>(2.0 * 86.6 * 32 * problem->seconds / (falls ? 11 : 4))};
    note(label + "  " + problem->id);
    const std::string reason = obstacle(*problem);
    if (!reason.empty()) {
      text += falls ? " | - | -" : " | -";
      continue;
    }
    const PeerRun run = load(*problem)->run(setting);
    if (!run.is_finished) {
      text += formatted(falls ? " | ended at %.2g s | -" : " | ended at %.2g s",
                        problem->seconds * static_cast<double>(run.snapshots.size()) / setting.snapshots);
      continue;
    }
    text += " | " + last_cost(*problem, setting, run);
    if (falls) text += formatted(" | %.2g", 1e3 * penetration(*problem, run.snapshots.back()));
  }
  return text + " |\n";
}

std::string feature_table() {
  std::string text =
      "| engine, cloth 32 | alone | dashpots | on a ball and a floor, after 1 s | depth there [mm] |\n|---|---|---|---|---|\n";
  const Integrator& verlet = default_integrator();
  text += feature_row(
      "Hooke, `velocity_verlet`", [&](const Problem& problem) { return load_method(problem, verlet); }, [](const Problem&) { return ""; });
  for (const PeerKind* kind : {&lammps_peer, &mujoco_euler_peer, &bullet_soft_body_peer, &bullet_deformable_peer})
    text += feature_row("`" + kind->id + "`", kind->load, kind->obstacle);
  return text;
}

std::string folds_row(const std::string& label, Peer& peer, const Problem& problem, int steps, double thickness_factor) {
  const PeerSetting setting{.snapshots = static_cast<int>(std::lround(60.0 * problem.seconds)),
                            .steps = steps,
                            .thickness_factor = thickness_factor,
                            .max_cpu_seconds = 60.0};
  note(label + formatted(", %d steps a frame", steps));
  const PeerRun run = peer.run(setting);
  note(formatted("%.3g s of CPU time", run.total_cpu_seconds()));
  const CrossingCounter counter(problem.system);
  long worst = 0, last = 0;
  int crossed = 0;
  for (const State& state : run.snapshots) {
    last = counter.count(state.position);
    worst = std::max(worst, last);
    crossed += last > 0 ? 1 : 0;
  }
  const double steps_taken = static_cast<double>(setting.steps) * static_cast<double>(run.cpu_seconds.size());
  return formatted("| %s | %g | %d | %.3g | %.3g | %zu | %d | %ld | %ld |\n", label.c_str(),
                   1e3 * thickness_factor * problem.system.contact.thickness, steps,
                   1e9 * run.total_cpu_seconds() / steps_taken / problem.system.spring_count(), run.total_cpu_seconds(),
                   run.snapshots.size(), crossed, worst, last);
}

std::string folds_table(int n) {
  const Problem problem = cloth_in_folds(n, 0.6);
  const Integrator& verlet = default_integrator();
  const int steps = static_cast<int>(std::ceil(2.0 / (60.0 * stable_step(problem, verlet))));
  std::string text = formatted(
      "| engine, cloth %d in its own folds | thickness [mm] | steps a frame | ns per spring and step | CPU s | frames | of them with "
      "crossings | "
      "most crossings | at the end |\n|---|---|---|---|---|---|---|---|---|\n",
      n);
  text += folds_row("Hooke, `velocity_verlet`", *load_method(problem, verlet), problem, steps, 1.0);
  for (const double factor : {1.0, 2.0})
    text += folds_row("`bullet_deformable`", *bullet_deformable_peer.load(problem), problem, steps, factor);
  return text;
}

int run(int argc, char** argv) {
  if (argc < 2) throw std::runtime_error("peers_bench FOLDER [PROBLEM | costs | folds]...");
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const std::vector<std::string> chosen(argv + 2, argv + argc);
  const auto is_chosen = [&](const std::string& id) { return chosen.empty() || std::ranges::find(chosen, id) != chosen.end(); };

  Results results{.conditions = {.version = "", .build = "", .machine = machine(), .effort = "peers"}};
  std::string tables;
  for (const Problem& problem : peer_problems()) {
    if (!is_chosen(problem.id)) continue;
    std::vector<std::string> obstacles;
    results.problems.push_back(compare_on(problem, obstacles));
    tables += table_of(results.problems.back(), obstacles);
  }
  results.date = time_text("%Y-%m-%dT%H:%M:%SZ");
  const std::string conditions = formatted("Measured %s, one thread of: %s.", results.date.c_str(), results.conditions.machine.c_str());
  if (!tables.empty()) {
    write_atomically(folder / "peers.json", format_results(results));
    write_atomically(folder / "peers.md",
                     conditions + " CPU milliseconds per simulated second for a relative error of at most:\n" + tables);
    if (const auto failure = draw_chart(work_precision_chart(results), folder / "peers.svg")) throw std::runtime_error(*failure);
  }
  std::string costs;
  if (is_chosen("costs")) costs += feature_table() + "\n";
  if (is_chosen("folds")) costs += folds_table(64);
  if (!costs.empty()) write_atomically(folder / "costs.md", conditions + " ns per spring and step:\n\n" + costs);
  return 0;
}

}  // namespace
}  // namespace hooke

int main(int argc, char** argv) {
  try {
    return hooke::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "peers_bench: %s\n", error.what());
    return 1;
  }
}
