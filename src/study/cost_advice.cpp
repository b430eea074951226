#include "study/cost_advice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "base/text_lines.h"
#include "base/threads/thread_time.h"
#include "lab/accuracy/accuracy_text.h"
#include "lab/lab.h"
#include "sim/contact/contact.h"
#include "sim/control/automatic.h"
#include "sim/control/frame_error.h"
#include "sim/control/frame_runner.h"
#include "sim/methods/rows.h"
#include "sim/methods/step_limits.h"
#include "sim/step/divergence.h"
#include "study/remedy/remedy.h"

namespace hooke {
namespace {

// A method that happens to be accurate now may not be a moment later: the frames that follow the present state and two later ones count.
constexpr int frame_count = 4, frames_apart = 15, start_count = 3;

class Frames {
 public:
  Frames(const System& system, const State& state, const std::atomic<bool>& stop)
      : system_(system), starts_{state}, plan_(make_plan(system)), stop_(stop) {}

  // Adds the later states that a run with these settings reaches; false if it fails or is stopped.
  bool add_starts(const Settings& settings) {
    while (starts_.size() < start_count) {
      State state = starts_.back();
      for (int frame = 0; frame < frames_apart; ++frame)
        if (!compute_frame(settings, state, HUGE_VAL)) return false;
      starts_.push_back(std::move(state));
    }
    return true;
  }

  const Plan& plan() const { return plan_; }

  struct Result {
    std::vector<std::vector<Vec3>> positions;  // [m], at the ends of the frames, start by start
    double seconds = 0.0;                      // of CPU time
  };
  // None if a frame fails, or if they take longer than `max_seconds` of CPU time, or are stopped.
  std::optional<Result> compute(const Settings& settings, double max_seconds = HUGE_VAL) {
    Result result;
    // the first time includes the analysis of the matrix that later frames share
    for (const bool is_first : {true, false}) {
      result.positions.clear();
      refresh_values(plan_, system_);
      const double start = thread_cpu_seconds();
      for (State state : starts_)
        for (int frame = 0; frame < frame_count; ++frame) {
          if (!compute_frame(settings, state, is_first ? HUGE_VAL : start + max_seconds)) return std::nullopt;
          result.positions.push_back(state.position);
        }
      result.seconds = thread_cpu_seconds() - start;
    }
    return result;
  }

  // [m], for each start the largest distance at the end of a frame.
  std::array<double, start_count> distances(const Result& one, const Result& other) const {
    std::array<double, start_count> largest{};
    for (std::size_t f = 0; f < one.positions.size(); ++f)
      largest[f / frame_count] =
          std::max(largest[f / frame_count], weighted_distance(system_, one.positions[f], other.positions[f], 1.0).rms);
    return largest;
  }

 private:
  // `end`: of the CPU time of this thread [s].
  bool compute_frame(const Settings& settings, State& state, double end) {
    frame_.begin(plan_, system_, settings, state);
    while (!frame_.done()) {
      frame_.substep(plan_);
      if (stop_ || (std::isfinite(end) && thread_cpu_seconds() > end)) return false;
    }
    frame_.end(plan_, state);
    return frame_.failure() == StepFailure::None && is_finite(state);
  }

  const System& system_;
  std::vector<State> starts_;
  Plan plan_;
  FrameRunner frame_;
  const std::atomic<bool>& stop_;
};

// The fewest that are stable and resolve the oscillations of the colliders; none if the latter are too many.
std::optional<int> min_substeps(const Plan& plan, const Integrator& method, double frame_rate) {
  const StepLimits limits(plan.spectrum, {.oscillation = plan.resolving_step()});
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

// The search for one piece of advice after the other, with the present settings as the measure.
class Search {
 public:
  Search(Frames& frames, const Settings& settings, const Frames::Result& reference, const Frames::Result& present)
      : frames_(frames), settings_(settings), reference_(reference), present_(present), errors_(frames.distances(present, reference)) {}

  std::optional<TestedCost> test(const Settings& settings, double max_cost) {
    const auto result = frames_.compute(settings, max_cost * present_.seconds);
    if (!result || result->seconds > max_cost * present_.seconds) return std::nullopt;
    const auto errors = frames_.distances(*result, reference_);
    double error = 0.0;
    for (std::size_t start = 0; start < errors.size(); ++start) error = std::max(error, errors[start] / errors_[start]);
    return TestedCost{settings, error, result->seconds / present_.seconds};
  }

  // The present method with a finer step or a smaller tolerance.
  std::optional<TestedCost> half_error() {
    constexpr double max_cost = 16.0, refinement = 1.25;
    Settings settings = settings_;
    const bool has_tolerance = settings.integrator->stability == Stability::Adaptive;
    const double tolerance = settings.tolerance.value_or(is_automatic(settings) ? default_automatic_tolerance : default_tolerance);
    for (double factor = refinement; factor <= max_cost; factor *= refinement) {
      if (has_tolerance)
        settings.tolerance = tolerance / factor;
      else
        settings.substeps = std::max(settings.substeps + 1, static_cast<int>(factor * settings_.substeps));
      const auto tested = test(settings, max_cost);
      if (!tested) return std::nullopt;
      if (tested->error <= 0.5) return tested;
    }
    return std::nullopt;
  }

  // Ever more substeps of another method, for as long as they cost no more than the present settings.
  void try_method(const Integrator& method, CostAdvice& advice) {
    constexpr int max_substeps = 1 << 14;
    Settings settings = settings_;
    settings.integrator = &method;
    settings.tolerance.reset();
    // a quarter more than the fewest stable ones, or one
    settings.substeps = min_substeps(frames_.plan(), method, settings.frame_rate).value_or(max_substeps + 1);
    if (settings.substeps > 1) settings.substeps += (settings.substeps + 3) / 4;
    while (settings.substeps <= max_substeps) {
      const auto tested = test(settings, max_same_cost);
      if (!tested) return;
      const double max_cost = advice.cheaper ? advice.cheaper->cost : 1.0 / worthwhile_saving;
      if (tested->error <= 1.0 && tested->cost < max_cost) advice.cheaper = tested;
      const double max_error = advice.better ? advice.better->error : 1.0 / worthwhile_accuracy;
      if (tested->error < max_error) advice.better = tested;
      settings.substeps = std::max(settings.substeps + 1, settings.substeps * 3 / 2);
    }
  }

 private:
  Frames& frames_;
  const Settings& settings_;
  const Frames::Result &reference_, &present_;
  const std::array<double, start_count> errors_;  // [m], of the present settings
};

double max_error(const Accuracy& accuracy) { return std::max(accuracy.accumulated.value.value_or(0.0), accuracy.max_accumulated.error); }

}  // namespace

CostAdvice advise_on_cost(const System& system, const State& state, const Settings& settings, const std::atomic<bool>& stop) {
  CostAdvice advice;
  if (system.point_count() == 0) return advice;
  Frames frames(system, state, stop);
  if (!frames.add_starts(settings)) return advice;
  const auto reference = frames.compute(exact(system, settings, frames.plan())), present = frames.compute(settings);
  constexpr double round_off = 1e-14;  // [m]
  if (!reference || !present || !(std::ranges::min(frames.distances(*present, *reference)) > round_off)) return advice;

  Search search(frames, settings, *reference, *present);
  advice.half_error = search.half_error();
  for (const Integrator& method : integrators())
    if (method.for_production && &method != settings.integrator && method.stability != Stability::Adaptive && !is_automatic(settings))
      search.try_method(method, advice);
  if (stop) return {};
  return advice;
}

std::optional<std::string> advise_on_tolerance(Scene start, long frames, const Accuracy& accuracy) {
  const auto tolerance = tolerance_to_try(accuracy, start.settings);
  if (!tolerance) return std::nullopt;
  start.settings.integrator = &automatic_method();
  start.settings.tolerance = *tolerance;
  Lab lab(std::move(start), KeepStart::No);
  lab.submit(SetAccuracy{AccuracyMode::Full});
  TrialWork work(lab.plan());
  // measuring takes half as long again as the run
  double left = 0.4 * default_remedy_work;
  for (; frames > 0 && left > 0.0; --frames, left -= work.since_last(lab.last_frame(), true))
    if (!lab.step()) return std::nullopt;
  const Accuracy found = lab.accuracy();
  const double error = max_error(found);
  if (left <= 0.0 || !found.accumulated.value || (accuracy.accumulated.value && error > 0.5 * max_error(accuracy))) return std::nullopt;
  return "With auto and a tolerance of " + quantity_text(*tolerance, "m/s", 1) +
         ", a copy of this run has an accumulated error of at most " + length_text(error) + ".";
}

std::string describe(const TestedCost& tested, const Settings& present) {
  const Settings& settings = tested.settings;
  const std::string method = settings.integrator != present.integrator ? settings.integrator->short_name() + ", " : "";
  const std::string setting = settings.integrator->stability == Stability::Adaptive
                                  ? "tolerance " + quantity_text(settings.tolerance.value_or(default_tolerance), "m", 2)
                                  : pluralize(static_cast<std::size_t>(settings.substeps), "substep", "substeps");
  constexpr double noticed = 1.8;  // [1]
  const double ratio = 1.0 / tested.error;
  const std::string error = !(ratio > noticed) ? "the same error"
                            : ratio > 1e6      ? "more than a million times less error"
                                               : number_text(ratio, 2) + " times less error";
  const std::string time = tested.cost < 0.95 ? number_text(std::round(100.0 * tested.cost)) + " % of the time"
                                              : number_text(tested.cost, 2) + " times the time";
  return method + setting + ": " + error + ", " + time;
}

}  // namespace hooke
