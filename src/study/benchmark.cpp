#include "study/benchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/formatted.h"
#include "base/threads/thread_time.h"
#include "sim/control/frame_error.h"
#include "sim/step/divergence.h"

namespace hooke {
namespace {

// Distances beyond this multiple of the size of the scene count as diverged. The energy check of the laboratory is too strict here: a
// method with a small error in a stiff spring has a multiple of the energy of the scene and must still be measured.
constexpr double out_of_bounds = 1e6;

void add(RunResult& result, const Motion& motion) {
  result.work.force_evaluations += motion.counts.force_evaluations;
  result.work.factorizations += motion.counts.factorizations;
  result.work.solves += motion.counts.solves;
  result.work.sweeps += motion.counts.sweeps;
  result.unconverged_solves += motion.counts.unconverged_solves;
}

int frames_between_snapshots(const Problem& problem, double frame_rate) {
  return std::max(1, static_cast<int>(std::lround(frame_rate * problem.seconds / snapshot_count)));
}

}  // namespace

bool is_adaptive(const Integrator& method) { return method.stability == Stability::Adaptive; }

double rms_distance(const System& system, const State& first, const State& second) {
  return weighted_distance(system, first.position, second.position, 1.0).rms;
}

Benchmark::Benchmark(const Problem& problem)
    : problem_(problem), frames_(frames_between_snapshots(problem, problem.frame_rate)), plan_(make_plan(problem.system)) {}

RunResult Benchmark::run(const Integrator& method, const Setting& setting, const std::function<bool()>& should_continue) {
  return run(method, setting, problem_.start, should_continue);
}

RunResult Benchmark::run(const Integrator& method, const Setting& setting, const State& start,
                         const std::function<bool()>& should_continue) {
  // `auto` chooses from frame to frame, and does so as in a laboratory
  const bool is_auto = &method == &automatic_method();
  const int frames = is_auto && problem_.frame_rate == 0.0 ? frames_between_snapshots(problem_, 60.0) : frames_;
  const Settings settings{.integrator = &method,
                          .frame_rate = frames * snapshot_count / problem_.seconds,
                          .substeps = setting.steps,
                          .tolerance = setting.tolerance};
  const double trials_before = frame_.trial_cost();
  // an adaptive method takes an unknown number of its own steps, one per call
  const int calls_per_poll = is_adaptive(method) ? 16 : std::max(1, setting.steps / 256);
  RunResult result;
  State state = start;
  if (!plan_.spring.break_length.empty()) refresh_values(plan_, problem_.system);  // restores springs that broke in the previous run

  for (int i = 0; i < frames * snapshot_count; ++i) {
    const double begin = now();
    frame_.begin(plan_, problem_.system, settings, state);
    for (int calls = 1; !frame_.done(); ++calls) {
      frame_.substep(plan_);
      if (calls % calls_per_poll == 0 && !should_continue()) {
        result.end = RunResult::End::Stopped;
        return result;
      }
    }
    frame_.end(plan_, state);
    if (frame_.failure() != StepFailure::None) {
      result.end = frame_.failure() == StepFailure::MatrixTooLarge ? RunResult::End::TooLarge : RunResult::End::Diverged;
      return result;
    }
    result.cpu_seconds += now() - begin;
    add(result, frame_.motion());
    if (is_auto) result.model_ms += frame_.cost(plan_);

    if (!is_finite(state) || rms_distance(problem_.system, state, start) > out_of_bounds * problem_.size) {
      result.end = RunResult::End::Diverged;
      return result;
    }
    if ((i + 1) % frames == 0) result.snapshots.push_back(state);
  }
  result.model_ms += frame_.trial_cost() - trials_before;
  return result;
}

double Benchmark::now() const {
  const std::chrono::duration<double> real = std::chrono::steady_clock::now().time_since_epoch();
  return plan_.execution.device != nullptr ? real.count() : thread_cpu_seconds();
}

Setting Benchmark::finer(const Setting& setting) const {
  if (!setting.tolerance) return {.steps = 2 * setting.steps};
  return {.steps = setting.steps, .tolerance = 0.1 * *setting.tolerance};
}

std::string Benchmark::name(const Setting& setting) const {
  return setting.tolerance ? formatted("tolerance %.0e", *setting.tolerance) : formatted("%.10g steps/s", 1.0 / step(setting));
}

}  // namespace hooke
