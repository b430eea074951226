#include "sim/step/automatic/automatic.h"

#include <algorithm>
#include <cmath>

#include "base/file_limits.h"
#include "base/formatted.h"

namespace hooke {
double automatic_tolerance(const Settings& settings) { return settings.tolerance.value_or(default_automatic_tolerance); }

bool is_valid(const MethodMemory& memory) {
  const auto is_number = [](int substeps) { return substeps >= 1 && substeps <= max_substeps; };
  const auto is_possible = [&](const MethodChoice& choice) {
    return choice.method->stability != Stability::Adaptive && is_number(choice.substeps) && is_number(choice.min_substeps) &&
           is_number(choice.next_substeps) && choice.frequency > 0.0 && choice.period >= 1 && choice.interval >= 1;
  };
  return (!memory.choice || is_possible(*memory.choice)) && memory.islands.size() <= IslandStepsList::max_size &&
         std::ranges::all_of(memory.islands, is_possible);
}

Settings settings_used(const Settings& settings, const State& after) {
  Settings used = settings;
  if (!is_automatic(settings) || !after.memory.choice) return used;
  used.integrator = after.memory.choice->method;
  used.substeps = after.memory.choice->substeps;
  used.tolerance.reset();
  for (const MethodChoice& choice : after.memory.islands) used.islands.push_back({choice.method, choice.substeps});
  return used;
}

double error_per_second(const MethodChoice& choice, const Settings& settings) { return choice.ratio * choice.target * settings.frame_rate; }

bool is_tolerance_met(const MethodChoice& choice, const Settings& settings) {
  return error_per_second(choice, settings) <= automatic_tolerance(settings);
}

std::string describe(const MethodChoice& choice, const Settings& settings) {
  const double error = error_per_second(choice, settings), tolerance = automatic_tolerance(settings);
  const std::string steps =
      choice.method->short_name() + ", " + std::to_string(choice.substeps) + (choice.substeps == 1 ? " substep" : " substeps");
  std::string text;
  if (!std::isfinite(error))
    text = ": tolerance not met: no method could be tested on this frame.";
  else if (error > tolerance)
    text = formatted(": tolerance not met: %.1g m/s%s%s.", error, choice.breaks ? ", as springs break" : "",
                     choice.budget > 0.0 ? " within the budget" : "");
  else if (choice.breaks)
    text = formatted(": limited by springs that break in this frame; the error is %.1g m/s.", error);
  else if (choice.substeps == choice.min_substeps && choice.min_substeps > 1)
    text = formatted(": limited by %s; the error, %.1g m/s, is %s the tolerance.",
                     choice.resolves_collider ? "a collider that oscillates" : "stability", error,
                     error < 0.01 * tolerance ? "far below" : "within");
  else
    text = formatted(": the error is %.1g m/s.", error);
  const bool is_late = choice.budget > 0.0 && choice.cost > 1.25 * choice.budget;
  return steps + text + (is_late ? " Nothing that is stable is within the budget." : "");
}

std::string describe(const MethodMemory& memory, const Settings& settings) {
  if (memory.islands.empty()) return describe(*memory.choice, settings);
  std::string text = "Parts that do not affect each other have their own steps.";
  for (const MethodChoice& choice : memory.islands) text += " " + describe(choice, settings);
  return text;
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
