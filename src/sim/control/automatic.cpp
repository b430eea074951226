#include "sim/control/automatic.h"

#include <algorithm>
#include <cmath>

#include "base/file_limits.h"
#include "base/formatted.h"
#include "sim/control/constants.h"

namespace hooke {
double automatic_tolerance(const Settings& settings) { return settings.tolerance.value_or(default_automatic_tolerance); }

bool is_valid(const MethodMemory& memory) {
  const auto is_number = [](int substeps) { return substeps >= 1 && substeps <= max_substeps; };
  if (!memory.choice) return true;
  const MethodChoice& choice = *memory.choice;
  return choice.method->step != nullptr && is_number(choice.substeps) && is_number(choice.min_substeps) &&
         is_number(choice.next_substeps) && choice.selected_substeps >= 0 && choice.selected_substeps <= max_substeps &&
         choice.ratio >= 0.0 && !(choice.error && !(*choice.error >= 0.0));
}

void estimate_after_edit(MethodMemory& memory) {
  if (memory.choice) memory.choice->until_estimate = 0;
}

Settings settings_used(const Settings& settings, const State& after) {
  Settings used = settings;
  if (!is_automatic(settings) || !after.memory.choice) return used;
  used.integrator = after.memory.choice->method;
  used.substeps = after.memory.choice->substeps;
  used.tolerance.reset();
  return used;
}

double error_per_second(const MethodChoice& choice, const Settings& settings) { return choice.error.value_or(0.0) * settings.frame_rate; }

bool is_tolerance_met(const MethodChoice& choice, const Settings& settings) {
  return error_per_second(choice, settings) <= automatic_tolerance(settings);
}

std::string describe(const MethodChoice& choice, const Settings& settings) {
  const double error = error_per_second(choice, settings), tolerance = automatic_tolerance(settings);
  const std::string steps =
      choice.method->short_name() + ", " + std::to_string(choice.substeps) + (choice.substeps == 1 ? " substep" : " substeps");
  std::string text;
  const bool is_of_stability = choice.substeps <= 2 * choice.min_substeps && choice.min_substeps > 1;
  if (!choice.error)
    text = ": the fewest that are stable; the error was far below the tolerance.";
  else if (!std::isfinite(error))
    text = ": tolerance not met: no two runs of this frame agree.";
  else if (error > tolerance)
    text = formatted(": tolerance not met: %.1g m/s%s.", error, settings.budget_ms > 0.0 ? " within the budget" : "");
  else
    text = formatted(": %sthe error is %.1g m/s.", is_of_stability ? "the fewest that are stable and resolve what moves; " : "", error);
  return steps + text;
}

void ToleranceMonitor::add_frame(const Settings& settings, const State& after) {
  const auto& choice = after.memory.choice;
  if (!is_automatic(settings) || !choice) return;
  ++frames_;
  if (is_tolerance_met(*choice, settings)) return;
  ++beyond_;
  max_error_ = std::max(max_error_, error_per_second(*choice, settings));
}

std::string ToleranceMonitor::warning() const {
  if (beyond_ == 0) return {};
  return "the tolerance was not met in " + std::to_string(beyond_) + " of " + std::to_string(frames_) + " frames" +
         (std::isfinite(max_error_) ? formatted(": up to %.2g m/s", max_error_) : "");
}

}  // namespace hooke
