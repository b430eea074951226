// What the method `auto` costs, with the frames that it computes to choose, relative to the cheapest fixed method and number of substeps
// that would have kept every frame within the same tolerance, and whether it does so itself. HOOKE_PRINT=1 measures all problems of the
// benchmark, in half an hour, HOOKE_PROBLEM=ID one of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/threads/thread_time.h"
#include "sim/control/automatic.h"
#include "sim/control/method_selector.h"
#include "sim/step/divergence.h"
#include "study/benchmark.h"

namespace hooke {
namespace {

constexpr double frame_rate = 60.0;  // [1/s]

bool prints() { return std::getenv("HOOKE_PRINT") != nullptr; }

bool is_tested(const BuiltInProblem& problem) {
  const char* only = std::getenv("HOOKE_PROBLEM");
  return only != nullptr ? problem.id == only : prints() || problem.id == "net_w2" || problem.id == "rope_64";
}

struct CostOfFrames {
  double model = 0.0, cpu = 0.0;  // [ms]
};

// Computes frames of a problem one by one, from any states.
class TimedFrames {
 public:
  explicit TimedFrames(const Problem& problem) : problem_(problem), plan_(make_plan(problem.system)) {}

  // The state after the frame. Not finite if the method failed.
  State next(const Settings& settings, const State& state) {
    State after = state;
    refresh_values(plan_, problem_.system);
    const double start = thread_cpu_seconds(), trials = frame_.trial_cost();
    frame_.begin(plan_, problem_.system, settings, state);
    while (!frame_.done()) frame_.substep(plan_);
    frame_.end(plan_, after);
    cost_.cpu += 1e3 * (thread_cpu_seconds() - start);
    cost_.model += frame_.cost(plan_) + frame_.trial_cost() - trials;
    if (frame_.failure() != StepFailure::None) after.position.front() = Vec3(NAN);
    return after;
  }
  const CostOfFrames& cost() const { return cost_; }

 private:
  const Problem& problem_;
  Plan plan_;
  FrameRunner frame_;
  CostOfFrames cost_;
};

// A run with `auto`.
struct AutomaticRun {
  std::vector<State> starts, exact;  // of each frame, and its converged end
  CostOfFrames cost;
  int beyond = 0, reported = 0, silent = 0;  // frames beyond the tolerance, reported as such, and beyond without a report
  MethodChoice last;
};

AutomaticRun run_automatic(const Problem& problem, double tolerance) {
  const Settings converged{.integrator = find_integrator("dop853"), .substeps = 1, .tolerance = 1e-13};
  const Settings settings{.integrator = &automatic_method(), .tolerance = tolerance};
  TimedFrames frames(problem), exact(problem);
  AutomaticRun run;
  State state = problem.start;
  while (static_cast<double>(run.starts.size()) < frame_rate * problem.seconds) {
    run.starts.push_back(state);
    run.exact.push_back(exact.next(converged, state));
    state = frames.next(settings, state);
    run.last = *state.memory.choice;
    const bool is_beyond = !(frame_rate * rms_distance(problem.system, state, run.exact.back()) <= tolerance);
    const bool is_reported = !is_tolerance_met(run.last, settings);
    run.beyond += is_beyond ? 1 : 0;
    run.reported += is_reported ? 1 : 0;
    run.silent += is_beyond && !is_reported ? 1 : 0;
  }
  run.cost = frames.cost();
  return run;
}

struct BestFixed {
  CostOfFrames cost{HUGE_VAL, HUGE_VAL};
  std::string name;
};

// The cheapest by the model, of steps that are stable and resolve what `auto` resolves.
BestFixed best_with_hindsight(const Problem& problem, const AutomaticRun& run, double tolerance) {
  BestFixed best;
  const Plan plan = make_plan(problem.system);
  const StepLimits limits(plan.spectrum, {});
  // from the states of that run, unless it costs too much
  const auto keeps_tolerance = [&](const Settings& settings) {
    TimedFrames frames(problem);
    for (std::size_t f = 0; f < run.starts.size(); ++f) {
      const State end = frames.next(settings, run.starts[f]);
      if (!is_finite(end) || !(frame_rate * rms_distance(problem.system, end, run.exact[f]) <= tolerance)) return false;
      if (!(frames.cost().model < best.cost.model)) return false;
    }
    return true;
  };
  const auto cost_alone = [&](const Settings& settings) {
    TimedFrames frames(problem);
    State state = problem.start;
    for (std::size_t f = 0; f < run.starts.size(); ++f) state = frames.next(settings, state);
    const bool is_kept = rms_distance(problem.system, state, run.exact.back()) <= 2.0 * tolerance * problem.seconds;
    return is_finite(state) && is_kept ? frames.cost() : CostOfFrames{HUGE_VAL, HUGE_VAL};
  };
  for (const Integrator& method : integrators()) {
    const auto min = min_automatic_substeps(limits, method, frame_rate);
    if (!method.for_production || method.stability == Stability::Adaptive || !min) continue;
    for (double n = *min; n < max_automatic_substeps; n *= std::sqrt(2.0)) {
      const Settings settings{.integrator = &method, .substeps = static_cast<int>(std::round(n))};
      if (CostModel(plan).expected(method, settings.substeps) * frame_rate * problem.seconds > 2.0 * best.cost.model) break;
      if (!keeps_tolerance(settings)) continue;
      const CostOfFrames cost = cost_alone(settings);
      if (cost.model < best.cost.model) best = {cost, std::string(method.id) + " " + std::to_string(settings.substeps)};
      if (cost.model < HUGE_VAL) break;
    }
  }
  return best;
}

TEST(AutomaticCost, IsCloseToThatOfTheBestFixedMethodThatKeepsTheToleranceAsItDoes) {
  std::vector<double> ratios, cpu_ratios;
  for (const BuiltInProblem& row : built_in_problems()) {
    if (!is_tested(row)) continue;
    const Problem problem = row.make();
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      const AutomaticRun run = run_automatic(problem, tolerance);
      EXPECT_EQ(run.silent, 0) << row.id << " " << tolerance;
      EXPECT_EQ(run.reported, 0) << row.id << " " << tolerance;
      const BestFixed best = best_with_hindsight(problem, run, tolerance);
      ratios.push_back(run.cost.model / best.cost.model);
      // frames of less than 20 us count their own overhead
      if (run.cost.cpu > 0.02 * static_cast<double>(run.starts.size())) cpu_ratios.push_back(run.cost.cpu / best.cost.cpu);
      if (prints())
        std::printf("%-10s %.0e: %8.2f ms (cpu %8.2f) = %5.2f (%5.2f) x %8.2f ms of %s; %d beyond, %d reported; last %s %d\n",
                    problem.id.c_str(), tolerance, run.cost.model, run.cost.cpu, ratios.back(), run.cost.cpu / best.cost.cpu,
                    best.cost.model, best.name.c_str(), run.beyond, run.reported, run.last.method->id.data(), run.last.substeps);
      std::fflush(stdout);
    }
  }
  ASSERT_FALSE(ratios.empty() || cpu_ratios.empty());
  std::ranges::sort(ratios);
  std::ranges::sort(cpu_ratios);
  const auto median = [](const std::vector<double>& sorted) { return sorted[sorted.size() / 2]; };
  if (prints())
    std::printf("median %.2f, worst %.2f of %zu; of CPU time median %.2f, worst %.2f of %zu\n", median(ratios), ratios.back(),
                ratios.size(), median(cpu_ratios), cpu_ratios.back(), cpu_ratios.size());
  EXPECT_LE(median(ratios), 3.0);
  EXPECT_LE(ratios.back(), 5.0);
}

}  // namespace
}  // namespace hooke
