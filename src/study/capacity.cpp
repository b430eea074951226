#include "study/capacity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/file_limits.h"
#include "base/threads/thread_time.h"
#include "study/kernels/kernel_cases.h"

namespace hooke {
namespace {

constexpr std::array sizes{6, 8, 11, 16, 23, 32, 45, 64, 91, 128, 181, 256};
constexpr std::size_t quick_sizes = 4;
constexpr int frames = 16, frames_per_snapshot = frames / snapshot_count, runs = 3, refinements = 3;

Problem make_cloth_problem(int n) {
  Problem problem = make_problem("cloth", make_kernel_scene(kernel_cases().front(), n, 1));
  problem.seconds = frames / capacity_frame_rate;
  problem.size = 1.0;
  return problem;
}

// One method on one cloth.
class CapacitySearch {
 public:
  CapacitySearch(Benchmark& benchmark, const Reference& reference, const Integrator& method, double max_error,
                 const std::function<bool()>& should_continue)
      : benchmark_(benchmark), reference_(reference), method_(method), max_error_(max_error), should_continue_(should_continue) {}

  // The cheapest setting found that is within the time and the error; none if there is none.
  std::optional<Capacity> find() const { return is_adaptive(method_) ? find_tolerance() : find_substeps(); }

 private:
  enum class Outcome { Accurate, Inaccurate, TooSlow };
  struct Trial {
    Outcome outcome = Outcome::Inaccurate;
    Capacity capacity;
  };

  Trial try_setting(const Setting& setting) const {
    constexpr double max_seconds = frames / capacity_frame_rate;
    Trial trial{.capacity = {.setting = setting, .frame_seconds = HUGE_VAL}};
    for (int i = 0; i < runs; ++i) {
      const double begin = thread_cpu_seconds();
      const auto within_time = [&] { return thread_cpu_seconds() - begin < 2.0 * max_seconds && should_continue_(); };
      const RunResult result = benchmark_.run(method_, setting, within_time);
      if (result.end == RunResult::End::Stopped || result.end == RunResult::End::TooLarge) return {.outcome = Outcome::TooSlow};
      if (result.end == RunResult::End::Diverged) return {.outcome = Outcome::Inaccurate};
      trial.capacity.frame_seconds = std::min(trial.capacity.frame_seconds, result.cpu_seconds / frames);
      if (i > 0) continue;
      trial.capacity.relative_error =
          judge(benchmark_.problem(), Measure::Trajectory, reference_.snapshots(), result.snapshots).relative_error;
      if (!(trial.capacity.relative_error <= max_error_)) return trial;
    }
    trial.outcome = trial.capacity.frame_seconds <= 1.0 / capacity_frame_rate ? Outcome::Accurate : Outcome::TooSlow;
    return trial;
  }

  std::optional<Capacity> find_tolerance() const {
    for (double tolerance = max_error_; tolerance > 1e-14; tolerance *= 0.1) {
      const Trial trial = try_setting({.tolerance = tolerance});
      if (trial.outcome == Outcome::Accurate) return trial.capacity;
      if (trial.outcome == Outcome::TooSlow) return std::nullopt;
    }
    return std::nullopt;
  }

  // Doubles the substeps until the error is small enough, then bisects between the last two numbers.
  std::optional<Capacity> find_substeps() const {
    int too_few = 0, substeps = 1;
    std::optional<Capacity> best;
    while (!best) {
      const Trial trial = try_substeps(substeps);
      if (trial.outcome == Outcome::Accurate) best = trial.capacity;
      if (trial.outcome == Outcome::TooSlow || (trial.outcome == Outcome::Inaccurate && 2 * substeps > max_substeps)) break;
      if (trial.outcome == Outcome::Accurate) continue;
      too_few = substeps;
      substeps *= 2;
    }
    for (int i = 0; i < refinements && substeps - too_few > 1; ++i) {
      const int between = too_few + (substeps - too_few) / 2;
      const Trial trial = try_substeps(between);
      if (trial.outcome == Outcome::Inaccurate) {
        too_few = between;
      } else {
        substeps = between;
        if (trial.outcome == Outcome::Accurate) best = trial.capacity;
      }
    }
    return best;
  }

  Trial try_substeps(int substeps) const { return try_setting({.steps = frames_per_snapshot * substeps}); }

  Benchmark& benchmark_;
  const Reference& reference_;
  const Integrator& method_;
  double max_error_;
  const std::function<bool()>& should_continue_;
};

}  // namespace

int Capacity::substeps() const { return setting.steps / frames_per_snapshot; }

std::span<const int> capacity_sizes(bool quick) { return std::span(sizes).first(quick ? quick_sizes : sizes.size()); }

CapacityResult measure_capacity(std::span<const Integrator* const> methods, std::span<const int> all_sizes, double relative_error,
                                double reference_seconds, const std::function<void(int n)>& begin_size,
                                const std::function<bool()>& should_continue) {
  CapacityResult result;
  for (const Integrator* method : methods) result.rows.push_back({.method = method, .is_bounded = false});
  for (const int n : all_sizes) {
    if (std::ranges::all_of(result.rows, &CapacityRow::is_bounded)) break;
    begin_size(n);
    const Problem problem = make_cloth_problem(n);
    Benchmark benchmark(problem);
    const ReferenceResult reference = compute_reference(benchmark, reference_seconds, should_continue);
    if (!should_continue()) return result;
    // a tenth of the error to be measured
    if (!reference.reference || reference.reference->measure != Measure::Trajectory ||
        reference.reference->uncertainty() > 0.1 * relative_error) {
      result.reason = reference.reference ? "its uncertainty is more than a tenth of the error" : reference.reason;
      break;
    }
    result.largest_n = n;
    for (CapacityRow& row : result.rows) {
      if (row.is_bounded) continue;
      auto largest = CapacitySearch(benchmark, *reference.reference, *row.method, relative_error, should_continue).find();
      if (!should_continue()) return result;
      row.is_bounded = !largest;
      if (!largest) continue;
      largest->n = n;
      largest->springs = problem.system.spring_count();
      row.largest = *largest;
    }
  }
  return result;
}

}  // namespace hooke
