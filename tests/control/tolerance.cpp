// Whether the method `auto` keeps its tolerance on random scenes, or says that it does not:
//   tolerance [SEED [SCENES [FRAMES [FIRST]]]]
// FIRST: the number of the first scene. HOOKE_PRINT=1 prints the frames that are beyond or reported, but not both.
// Each frame is compared with a converged one from the same state. Fails if more than one frame in 10,000 is beyond its share of the
// tolerance without a report, if one is beyond twice that, or if more than 2 % of the reports are wrong.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>

#include "base/threads/thread_time.h"
#include "control/random_scenes.h"
#include "sim/control/automatic.h"
#include "sim/control/frame_error.h"
#include "sim/control/frame_runner.h"
#include "sim/methods/rows.h"
#include "sim/step/divergence.h"

namespace hooke {
namespace {

struct Count {
  long scenes = 0, frames = 0, beyond = 0, silent = 0, reports = 0, wrong = 0, unjudged = 0;
  double worst = 0.0;    // [1], silent error relative to the share
  double slowest = 0.0;  // [s]
  double cpu = 0.0;      // [s]
};

State frame_from(const TestSim& sim, const State& start, const Settings& settings, bool& failed) {
  Plan plan = make_plan(sim.system);
  FrameRunner frame;
  State end = start;
  frame.begin(plan, sim.system, settings, start);
  while (!frame.done()) frame.substep(plan);
  frame.end(plan, end);
  failed = frame.failure() != StepFailure::None || !is_finite(end);
  return end;
}

double distance_between(const TestSim& sim, const State& a, const State& b) {
  return weighted_distance(sim.system, a.position, b.position, 1.0).rms;
}

// The converged end of the frame, known to a tenth of the share; none: two results that should agree do not.
std::optional<State> converged(const TestSim& sim, const State& start, double frame_rate, double share, bool is_smooth) {
  bool failed = false;
  if (is_smooth) {
    const State end = frame_from(sim, start, {.integrator = &dop853, .frame_rate = frame_rate, .substeps = 1, .tolerance = 1e-13}, failed);
    if (!failed) return end;
  }
  std::optional<State> before;
  for (int substeps = 1 << 9; substeps <= 1 << 16; substeps *= 4) {
    Settings settings{.integrator = &velocity_verlet, .frame_rate = frame_rate, .substeps = substeps};
    settings.locates_breaks = true;
    const State end = frame_from(sim, start, settings, failed);
    if (!failed && before && distance_between(sim, *before, end) < 0.1 * share) return end;
    before = failed ? std::nullopt : std::optional(end);
  }
  return std::nullopt;
}

void remove_broken(TestSim& sim, const FrameRunner& frame, Plan& plan) {
  if (frame.broken().empty()) return;
  std::vector<Spring> springs = sim.system.springs();
  for (auto s = frame.broken().rbegin(); s != frame.broken().rend(); ++s) springs.erase(springs.begin() + *s);
  sim.system.set_springs(springs);
  plan = make_plan(sim.system);
}

void run(RandomScene& scene, int number, int frames, Count& count) {
  TestSim& sim = scene.sim;
  const Settings settings{.integrator = &automatic_method(), .tolerance = scene.tolerance};
  const double share = scene.tolerance / settings.frame_rate;
  Plan plan = make_plan(sim.system);
  FrameRunner frame;
  ++count.scenes;
  for (int i = 0; i < frames; ++i) {
    State after = sim.state;
    const double begin = thread_cpu_seconds();
    frame.begin(plan, sim.system, settings, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, after);
    const double spent = thread_cpu_seconds() - begin;
    count.cpu += spent;
    count.slowest = std::max(count.slowest, spent);
    ++count.frames;
    const MethodChoice& choice = *after.memory.choice;
    const bool is_reported = !is_tolerance_met(choice, settings);
    const bool is_smooth = !has_contact(sim.system) && sim.system.forces.empty() && scene.kind != "breaking";
    const auto truth = converged(sim, sim.state, settings.frame_rate, share, is_smooth);
    count.reports += is_reported;
    if (!truth) {
      ++count.unjudged;
    } else {
      const double error = distance_between(sim, after, *truth) / share;
      const bool is_beyond = !(error <= 1.0);
      count.beyond += is_beyond;
      count.wrong += is_reported && !is_beyond;
      if (is_beyond && !is_reported) {
        ++count.silent;
        count.worst = std::max(count.worst, error);
      }
      if (is_beyond != is_reported && std::getenv("HOOKE_PRINT") != nullptr)
        std::printf("  %s %d frame %d: %.3g of the share, estimate %.3g, %s\n", std::string(scene.kind).c_str(), number, i, error,
                    choice.error.value_or(-1.0) / share, describe(choice, settings).c_str());
    }
    if (!is_finite(after)) break;
    sim.state = after;
    remove_broken(sim, frame, plan);
  }
}

void print(const std::string& name, const Count& c) {
  std::printf(
      "%-9s %4ld scenes %6ld frames: %5ld beyond the share, %3ld silent (worst %.3g), %5ld reports, %3ld wrong, %ld not judged; "
      "%.2f s of CPU, slowest frame %.2g s\n",
      name.c_str(), c.scenes, c.frames, c.beyond, c.silent, c.worst, c.reports, c.wrong, c.unjudged, c.cpu, c.slowest);
}

}  // namespace
}  // namespace hooke

int main(int argc, char** argv) {
  using namespace hooke;
  const auto argument = [&](int i, long standard) { return argc > i ? std::atol(argv[i]) : standard; };
  const long seed = argument(1, 1), scenes = argument(2, 500), frames = argument(3, 40), first = argument(4, 0);
  std::map<std::string, Count> kinds;
  Count all;
  for (int i = static_cast<int>(first); i < first + scenes; ++i) {
    RandomScene scene = make_random_scene(static_cast<unsigned long>(seed), i);
    run(scene, i, static_cast<int>(frames), kinds[std::string(scene.kind)]);
  }
  for (const auto& [name, c] : kinds) {
    print(name, c);
    all.scenes += c.scenes, all.frames += c.frames, all.beyond += c.beyond, all.silent += c.silent, all.reports += c.reports;
    all.wrong += c.wrong, all.unjudged += c.unjudged, all.cpu += c.cpu;
    all.worst = std::max(all.worst, c.worst), all.slowest = std::max(all.slowest, c.slowest);
  }
  print("all", all);
  const bool is_kept = all.silent <= (all.frames + 9999) / 10000 && all.worst <= 2.0 &&
                       static_cast<double>(all.wrong) <= 0.02 * static_cast<double>(all.reports) + 1.0;
  return is_kept ? EXIT_SUCCESS : EXIT_FAILURE;
}
