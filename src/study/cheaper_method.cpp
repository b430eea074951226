#include "study/cheaper_method.h"

#include <algorithm>
#include <cmath>

#include "base/threads/thread_time.h"
#include "sim/contact/contact.h"
#include "sim/control/automatic.h"
#include "sim/control/frame_error.h"
#include "sim/control/frame_runner.h"
#include "sim/methods/rows.h"
#include "sim/methods/step_limits.h"
#include "sim/step/divergence.h"

namespace hooke {
namespace {

class Frames {
 public:
  Frames(const System& system, const State& state, const std::atomic<bool>& stop)
      : system_(system), state_(state), plan_(make_plan(system)), stop_(stop) {}

  const Plan& plan() const { return plan_; }

  struct Result {
    std::vector<Vec3> position;
    double seconds = 0.0;  // of CPU time
  };
  // None if it takes longer than `max_seconds` of CPU time, or is stopped.
  std::optional<Result> compute(const Settings& settings, double max_seconds = HUGE_VAL) {
    FrameRunner frame;
    State to = state_;
    // twice, because the first time includes the analysis of the matrix that later frames share
    double seconds = 0.0;
    for (int time = 0; time < 2; ++time) {
      refresh_values(plan_, system_);
      const double start = thread_cpu_seconds();
      frame.begin(plan_, system_, settings, state_);
      while (!frame.done()) {
        frame.substep(plan_);
        if (stop_ || (time > 0 && thread_cpu_seconds() - start > max_seconds)) return std::nullopt;
      }
      frame.end(plan_, to);
      seconds = thread_cpu_seconds() - start;
    }
    return Result{to.position, seconds};
  }

 private:
  const System& system_;
  const State& state_;
  Plan plan_;
  const std::atomic<bool>& stop_;
};

// The fewest that are stable and resolve the oscillations of the colliders; none if the latter are too many.
std::optional<int> min_substeps(const Plan& plan, const Integrator& method, double frame_rate) {
  const StepLimits limits(plan.spectrum, {.oscillation = plan.collider_paths.resolving_step});
  const auto resolving = limits.resolving_substeps(method, frame_rate);
  if (!resolving) return std::nullopt;
  return std::max(*resolving, limits.stable_substeps(method, frame_rate).value_or(1));
}

// Far more accurate than the present settings.
Settings exact(const System& system, const Settings& settings, const Plan& plan) {
  if (!has_contact(system)) return {.integrator = &dop853, .frame_rate = settings.frame_rate, .substeps = 1, .tolerance = 1e-13};
  const int stable = min_substeps(plan, blanes_moan4, settings.frame_rate).value_or(settings.substeps);
  return {.integrator = &blanes_moan4, .frame_rate = settings.frame_rate, .substeps = 8 * std::max(stable, settings.substeps)};
}

}  // namespace

std::optional<CheaperMethod> find_cheaper_method(const System& system, const State& state, const Settings& settings,
                                                 const std::atomic<bool>& stop) {
  if (system.point_count() == 0 || is_automatic(settings)) return std::nullopt;
  Frames frames(system, state, stop);
  const auto reference = frames.compute(exact(system, settings, frames.plan()));
  const auto present = frames.compute(settings);
  if (!reference || !present) return std::nullopt;
  const auto error_of = [&](const Frames::Result& result) {
    return weighted_distance(system, result.position, reference->position, 1.0).rms;
  };
  constexpr double round_off = 1e-14;  // [m]
  const double allowed = error_of(*present);
  if (!(allowed > round_off)) return std::nullopt;

  std::optional<CheaperMethod> best;
  double max_seconds = present->seconds / worthwhile_saving;
  constexpr int max_substeps = 1 << 14;
  for (const Integrator& method : integrators()) {
    if (!method.for_production || &method == settings.integrator || method.stability == Stability::Adaptive) continue;
    Settings trial = settings;
    trial.integrator = &method;
    trial.tolerance.reset();
    // a quarter more than the fewest stable ones, or one, until the error is small enough
    trial.substeps = min_substeps(frames.plan(), method, settings.frame_rate).value_or(max_substeps + 1);
    if (trial.substeps > 1) trial.substeps += (trial.substeps + 3) / 4;
    while (trial.substeps <= max_substeps) {
      const auto result = frames.compute(trial, max_seconds);
      if (!result) break;
      const double error = error_of(*result);
      if (error <= allowed) {
        best = CheaperMethod{&method, trial.substeps, error, result->seconds / present->seconds};
        max_seconds = result->seconds;
        break;
      }
      trial.substeps = std::max(trial.substeps + 1, trial.substeps * 5 / 4);
    }
    if (stop) return std::nullopt;
  }
  return best;
}

}  // namespace hooke
