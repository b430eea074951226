#include "scene/step_advice.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/bounds.h"
#include "base/file_limits.h"
#include "base/number_text.h"
#include "sim/control/automatic.h"

namespace hooke {
namespace {

std::string count_substeps(int substeps) { return number_text(substeps) + (substeps == 1 ? " substep" : " substeps"); }

int with_margin(int substeps, int margin) { return static_cast<int>(std::min<long>(max_substeps, static_cast<long>(margin) * substeps)); }

// What a number of substeps costs that hardly anyone would run: ", which take about 5000 times as long"; empty for fewer.
std::string consequence_of(int substeps, int present) {
  constexpr int max_practical = 10'000;
  const double ratio = static_cast<double>(substeps) / present;
  return substeps > max_practical ? ", which take about " + number_text(std::round(ratio)) + " times as long" : "";
}

// [m/s], of the points that move.
double max_speed(const System& system, const State& state) {
  double max = 0.0;
  for (Index i = 0; i < system.point_count(); ++i)
    if (!system.points()[i].nailed) max = std::max(max, glm::length(state.velocity[i]));
  return max;
}

std::string describe(const Passage& passage) {
  return "a point may pass the center of a force at " + quantity_text(passage.speed, "m/s", 2) + " and " +
         quantity_text(passage.length, "m", 2);
}

}  // namespace

Advice suggest_stepping(const StepLimits& limits, const Settings& settings) {
  const Integrator& method = *settings.integrator;
  const auto substeps_of = [&](const Integrator& integrator) { return limits.recommended_substeps(integrator, settings.frame_rate); };
  // a method that amplifies every undamped mode also amplifies transverse motion, which dashpots do not damp
  if (const auto substeps = substeps_of(method); substeps && method.stability != Stability::None)
    return {&method, settings.substeps < *substeps ? *substeps : std::min(max_substeps, 4 * settings.substeps)};
  const Integrator& fallback = default_integrator();
  if (const auto substeps = substeps_of(fallback)) return {&fallback, *substeps};
  // a passage that takes so many steps of the same length takes few that are adapted
  const auto resolving = limits.resolving_substeps(fallback, settings.frame_rate);
  if (!resolving) return {&adaptive_integrator(), settings.substeps};
  // its limit is that of listed forces, which are part of the implicit system only in part
  const Integrator& stiff = stiff_integrator();
  const auto substeps = limits.stable_substeps(stiff, settings.frame_rate);
  return {&stiff, std::max(*resolving,
                           substeps && *substeps > settings.substeps ? with_margin(*substeps, limits.needs().margin) : settings.substeps)};
}

std::optional<std::string> step_warning(const System& system, const State& state, const Settings& settings) {
  const Spectrum spectrum = bound_spectrum(system, max_speed(system, state));
  const StepNeeds needs = step_needs(system, state);
  const StepLimits limits(spectrum, needs);
  const Integrator& method = *settings.integrator;
  const bool is_within_limit = settings.substep() <= limits.stable_step(method);
  // oscillations of colliders have a warning of their own
  const auto resolving = StepLimits(spectrum, {.passage = needs.passage}).resolving_substeps(method, settings.frame_rate);
  if (is_within_limit && resolving && settings.substeps >= *resolving) return std::nullopt;

  const std::string id(method.id);
  const Advice advice = suggest_stepping(limits, settings);
  if (const auto limit = limits.stable_substeps(method, settings.frame_rate); limit && advice.integrator == &method) {
    const bool has_margin = is_within_limit || *limit <= max_substeps / needs.margin;
    const std::string recommended =
        has_margin ? number_text(advice.substeps) + " are recommended" + consequence_of(advice.substeps, settings.substeps)
                   : "no number of substeps has the recommended margin";
    const std::string few = "simulation.substeps: " + number_text(settings.substeps) + ": may be too few for " + id + " here: ";
    if (is_within_limit) return few + describe(needs.passage) + "; " + recommended;
    return few + limits.limit_text(method, settings.frame_rate) + "; " + recommended;
  }
  const std::string reason = method.stability == Stability::None ? "amplifies undamped motion at every step"
                                                                 : "needs more than " + number_text(max_substeps) + " substeps per frame";
  const std::string other(advice.integrator->id);
  // only a bound on the step can be recommended without a test
  if (advice.integrator == &method || !std::isfinite(limits.stable_step(*advice.integrator)))
    return "simulation.integrator: " + id + ": " + reason + " here";
  if (!limits.stable_substeps(*advice.integrator, settings.frame_rate))
    return "simulation.integrator: " + id + ": " + reason + " here, and " +
           (method.stability == Stability::None ? other + " needs more than " + number_text(max_substeps) + " substeps per frame"
                                                : "so does " + other);
  return "simulation.integrator: " + id + ": " + reason + " here; " + other + " with " + count_substeps(advice.substeps) +
         " per frame is recommended";
}

std::optional<std::string> oscillation_warning(const System& system, const Settings& settings) {
  const auto [is_muscle, index, step] = fastest_oscillation(system);
  const double needed = std::ceil(1.0 / (settings.frame_rate * step) * (1.0 - 1e-9));
  const int available = is_automatic(settings) ? max_automatic_substeps : settings.substeps;
  const bool adapts = settings.integrator->stability == Stability::Adaptive && !is_automatic(settings);
  if (adapts || needed <= available) return std::nullopt;
  const std::string field = (is_muscle ? "springs[" : "colliders[") + std::to_string(index) + (is_muscle ? "].muscle" : "]");
  const double frequency = is_muscle ? system.springs()[index].law->frequency : system.colliders[index].path.frequency;
  const std::string text =
      field + ".frequency: " + number_text(frequency) + ": is not resolved by " + count_substeps(available) + " per frame";
  if (is_automatic(settings)) return text + ", the maximum of auto";
  if (needed > max_substeps) return text + ", nor by " + number_text(max_substeps);
  const int recommended = static_cast<int>(needed);
  return text + "; " + number_text(recommended) + " are recommended" + consequence_of(recommended, settings.substeps);
}

std::optional<std::string> unused_setting_warning(const Settings& settings) {
  const std::string id(settings.integrator->id);
  if (settings.tolerance && settings.integrator->stability != Stability::Adaptive)
    return "simulation.tolerance: " + format_exact(*settings.tolerance) + ": has no effect with " + id +
           ", which does not adapt its step; auto and dop853 do";
  if (settings.budget_ms > 0.0 && !is_automatic(settings))
    return "simulation.budget: " + format_exact(settings.budget_ms) + ": has no effect with " + id + ", only with auto";
  return std::nullopt;
}

std::vector<std::string> settings_warnings(const System& system, const State& state, const Settings& settings) {
  std::vector<std::string> warnings;
  for (const auto& warning :
       {unused_setting_warning(settings), step_warning(system, state, settings), oscillation_warning(system, settings)})
    if (warning) warnings.push_back(*warning);
  return warnings;
}

std::string describe(const Advice& advice) {
  return std::string(advice.integrator->label) + " with " + count_substeps(advice.substeps) + " per frame";
}

}  // namespace hooke
