#include "study/compare_methods.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/atomic_write.h"
#include "base/file_limits.h"
#include "base/number_text.h"
#include "study/work_precision_chart.h"

namespace hooke {
namespace {

constexpr std::array horizons{1.0, 0.5, 0.25, 0.125};  // [1], of the time wanted

// Growth of a perturbation beyond which small errors of a method become large ones within the compared time.
constexpr double max_amplification = 1e3;

bool is_predictable(const ReferenceRecord& reference) {
  return reference.measure == Measure::Trajectory && reference.amplification <= max_amplification;
}

}  // namespace

MethodComparison compare_methods(const System& system, const State& state, double seconds, const Effort& effort, const Progress& progress,
                                 double frame_rate) {
  MethodComparison comparison;
  Scene scene;
  scene.system = system;
  scene.state = state;
  const auto methods = integrators();
  for (const double part : horizons) {
    Problem problem = make_problem("scene", scene);
    problem.start.time = state.time;
    problem.seconds = part * seconds;
    problem.frame_rate = frame_rate;
    comparison.record = make_record(problem);
    PrecisionSweep sweep(problem, effort, comparison.record);
    double done = 0.0;
    bool is_stopped = false;
    sweep.should_continue = [&] {
      is_stopped = is_stopped || !progress(done);
      return !is_stopped;
    };
    bool has_failed = false;
    for (const Integrator& method : methods) {
      if (!sweep.run(method)) {
        has_failed = true;
        break;
      }
      const bool is_last = part == horizons.back();
      if (!is_last && !is_predictable(*comparison.record.reference)) break;
      done += 1.0 / static_cast<double>(methods.size());
    }
    const auto& reference = comparison.record.reference;
    if (is_stopped) {
      comparison.note = "Stopped.";
      return comparison;
    }
    if (!has_failed && (is_predictable(*reference) || part == horizons.back())) {
      if (!is_predictable(*reference))
        comparison.note =
            "The motion cannot be predicted even for " + quantity_text(problem.seconds, "s", 3) + ": errors are those of averages.";
      else if (part < 1.0)
        comparison.note = "Compared over " + quantity_text(problem.seconds, "s", 3) + ": the motion cannot be predicted for " +
                          quantity_text(seconds, "s", 3) + ".";
      return comparison;
    }
    if (has_failed && part == horizons.back()) comparison.note = "No reference to compare with: " + sweep.reference_failure_reason() + ".";
  }
  return comparison;
}

std::optional<int> substeps_of(const Row& row, double frame_rate) {
  if (!row.step || !(*row.step > 0.0)) return std::nullopt;
  const double substeps = std::ceil(1.0 / (frame_rate * *row.step) * (1.0 - 1e-9));
  return static_cast<int>(std::clamp(substeps, 1.0, static_cast<double>(max_substeps)));
}

std::string write_comparison(const MethodComparison& comparison, const std::filesystem::path& file) {
  const Results results{.conditions = {}, .date = {}, .problems = {comparison.record}};
  const std::filesystem::path extension = file.extension();
  try {
    if (extension == ".csv") {
      write_atomically(file, format_csv(results));
    } else if (extension == ".json") {
      write_atomically(file, format_results(results));
    } else if (extension == ".svg" || extension == ".png") {
      return draw_chart(work_precision_chart(results), file).value_or("");
    } else {
      return "no such format: must be .svg, .png, .csv or .json";
    }
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace hooke
