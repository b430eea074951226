// What the method `auto` costs, with the frames that it computes to choose, relative to the cheapest fixed method and step that reach the
// same error: those of docs/evidence/accuracy.json, known with hindsight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "base/read_file.h"
#include "sim/control/automatic.h"
#include "sim/control/cost_model.h"
#include "study/work_precision_file.h"
#include "support/next_frame.h"
#include "support/sanitizer_slowdown.h"

namespace hooke {
namespace {

bool prints() { return std::getenv("HOOKE_PRINT") != nullptr; }

// [ms], by the model, of a row of a fixed method.
double model_cost(const ProblemRecord& record, const Row& row, const Plan& plan) {
  const Integrator& method = *find_integrator(row.method);
  Motion motion;
  // in frames of 1/60 s, each of which starts with an evaluation
  motion.counts.force_evaluations =
      row.work.force_evaluations + (method.is_symplectic() && method.order > 1 ? std::lround(60.0 * record.seconds) : 0);
  motion.counts.factorizations = row.work.factorizations;
  motion.counts.solves = row.work.solves;
  motion.counts.sweeps = row.work.sweeps;
  const bool splits_dashpots = method.id == "velocity_verlet" || method.id == "blanes_moan4";
  if (splits_dashpots && plan.has_dashpots()) motion.counts.dashpot_sweeps = std::lround(2.0 * record.seconds / *row.step);
  return CostModel(plan).of(method, motion, 0);
}

struct Best {
  double cost = INFINITY;  // [ms]
  std::string name;
};

// The cheapest fixed setting with at most this error, interpolated between the settings that were measured.
Best with_hindsight(const ProblemRecord& record, const Plan& plan, double error) {
  Best best;
  const auto consider = [&](double cost, const Row& row) {
    if (cost < best.cost) best = {cost, row.method + " " + row.setting};
  };
  for (std::size_t i = 0; i < record.rows.size(); ++i) {
    const Row& row = record.rows[i];
    if (!row.step || !row.relative_error || row.status == status::unconverged) continue;
    const double e = std::max(*row.relative_error, 1e-16), cost = model_cost(record, row, plan);
    if (e <= error) {
      consider(cost, row);
      continue;
    }
    if (i + 1 == record.rows.size() || record.rows[i + 1].method != row.method || !record.rows[i + 1].relative_error) continue;
    const Row& finer = record.rows[i + 1];
    const double e2 = std::max(*finer.relative_error, 1e-16);
    if (!(e2 < error)) continue;
    const double part = std::log(e / error) / std::log(e / e2);
    consider(cost * std::pow(model_cost(record, finer, plan) / cost, part), row);
  }
  return best;
}

TEST(AutomaticCost, IsCloseToThatOfTheBestFixedMethod) {
  const Results results = parse_results(read_file(DOCS_FOLDER "/evidence/accuracy.json"), "docs/evidence/accuracy.json");
  const char* only = std::getenv("HOOKE_PROBLEM");
  std::vector<double> ratios;
  for (const ProblemRecord& record : results.problems) {
    const BuiltInProblem* built_in = find_problem(record.id);
    if (built_in == nullptr || (only != nullptr && record.id != only)) continue;
    if (!prints() && record.id != "net_w2" && record.id != "net_w4" && record.id != "net_w4d") continue;
    const Problem problem = built_in->make();
    Benchmark benchmark(problem);
    const Plan plan = make_plan(problem.system);
    const auto reference = compute_reference(benchmark, prints() ? 30.0 : 0.2 * sanitizer_slowdown, [] { return true; });
    ASSERT_TRUE(reference.reference) << record.id << ": " << reference.reason;
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      const auto run = benchmark.run(automatic_method(), {.tolerance = tolerance}, [] { return true; });
      if (run.end != RunResult::End::Finished) {
        ADD_FAILURE() << record.id << " " << tolerance << ": diverged";
        continue;
      }
      const double error = judge(problem, reference.reference->measure, reference.reference->snapshots(), run.snapshots).relative_error;
      const double floor = std::max({error, reference.reference->uncertainty(), 1e-14});
      const Best best = with_hindsight(record, plan, floor);
      const MethodChoice& choice = *run.snapshots.back().memory.choice;
      if (prints())
        std::printf("%-10s %.0e: error %.1e, cost %9.2f ms (cpu %9.2f) = %.2f x %9.2f ms of %s; last %s %d, ratio %.2g\n",
                    record.id.c_str(), tolerance, error, run.model_ms, 1e3 * run.cpu_seconds, run.model_ms / best.cost, best.cost,
                    best.name.c_str(), std::string(choice.method->id).c_str(), choice.substeps, choice.ratio);
      ratios.push_back(run.model_ms / best.cost);
    }
    std::fflush(stdout);
  }
  ASSERT_FALSE(ratios.empty());
  std::ranges::sort(ratios);
  const double median = ratios[ratios.size() / 2], worst = ratios.back();
  if (prints()) std::printf("median %.2f, worst %.2f of %zu\n", median, worst, ratios.size());
  // counts of work, the same on every machine: what is reached on three problems, and on all of them
  EXPECT_TRUE(only != nullptr || median <= 3.0) << median;
  // hindsight knows steps beyond the limit that is proven, and that dashpots need not be resolved
  EXPECT_LE(worst, prints() ? 31.0 : 10.0);
}

// Frame by frame on the run's own motion, against the converged frame from the same state.
TEST(AutomaticTolerance, IsKeptOnTheProblemsOfTheBenchmark) {
  const Settings exact{.integrator = find_integrator("dop853"), .substeps = 1, .tolerance = 1e-13};
  int all_frames = 0, all_kept = 0, silent = 0;  // silent: beyond the tolerance, and not reported
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    int frames = 0, kept = 0;
    for (const BuiltInProblem& row : built_in_problems()) {
      if (const char* only = std::getenv("HOOKE_PROBLEM"); only != nullptr && row.id != only) continue;
      if (!prints() && row.id != "net_w2" && row.id != "rope_64") continue;
      const Problem problem = row.make();
      State state = problem.start;
      Plan plan = make_plan(problem.system), exact_plan = plan;
      FrameRunner frame, exact_frame;
      const Settings settings{.integrator = &automatic_method(), .tolerance = tolerance};
      int kept_here = 0, frames_here = 0, reported = 0;
      double worst = 0.0;
      for (; frames_here < 60.0 * problem.seconds; ++frames_here) {
        const State after = next_frame(plan, frame, problem.system, settings, state);
        const double error = rms_distance(problem.system, after, next_frame(exact_plan, exact_frame, problem.system, exact, state));
        worst = std::max(worst, 60.0 * error / tolerance);
        kept_here += 60.0 * error <= tolerance ? 1 : 0;
        const bool is_met = is_tolerance_met(*after.memory.choice, settings);
        reported += is_met ? 0 : 1;
        silent += is_met && 60.0 * error > tolerance ? 1 : 0;
        state = after;
      }
      if (prints() && kept_here < frames_here)
        std::printf("%.0e %-10s %d of %d frames, worst %.2g of the tolerance; %d reported as beyond\n", tolerance,
                    std::string(row.id).c_str(), kept_here, frames_here, worst, reported);
      frames += frames_here;
      kept += kept_here;
    }
    if (prints()) std::printf("%.0e: %d of %d frames within the tolerance (%.1f %%)\n", tolerance, kept, frames, 100.0 * kept / frames);
    std::fflush(stdout);
    EXPECT_GE(kept, 0.95 * frames) << tolerance;
    all_frames += frames;
    all_kept += kept;
  }
  if (prints()) std::printf("%d of %d; %d beyond without being reported\n", all_kept, all_frames, silent);
  EXPECT_EQ(silent, 0);
}

}  // namespace
}  // namespace hooke
