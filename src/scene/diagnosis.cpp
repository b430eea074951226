#include "scene/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/file_limits.h"

namespace hooke {
namespace {

std::string format(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

std::string name_spring(const System& system, SpringId id) {
  const Spring& spring = system.springs()[system.index_of(id)];
  return "spring " + std::to_string(system.index_of(id)) + " (points " + std::to_string(system.index_of(spring.first)) + " and " +
         std::to_string(system.index_of(spring.second)) + ")";
}

std::string describe_location(const Divergence& divergence, const System& system) {
  std::string name;
  if (divergence.point && system.index_of(*divergence.point) != no_index)
    name = "point " + std::to_string(system.index_of(*divergence.point));
  if (divergence.spring && system.index_of(*divergence.spring) != no_index)
    name += (name.empty() ? "" : " on ") + name_spring(system, *divergence.spring);
  return name.empty() ? "the scene" : name;
}

// What no number of substeps helps.
std::string describe_instability(const Integrator& method, std::string_view name) {
  return std::string(name) + (method.stability == Stability::None
                                  ? " holds at no step"
                                  : " needs more than " + std::to_string(max_substeps) + " substeps a frame");
}

// "100", "2.5e+09"
std::string ratio(double value) { return format(value < 1e4 ? "%.0f" : "%.2g", value); }

}  // namespace

std::optional<int> min_stable_substeps(const Integrator& integrator, const Spectrum& spectrum, double frame_rate) {
  const double step = largest_stable_step(integrator, spectrum);
  if (step == 0.0) return std::nullopt;
  const double substeps = std::ceil(1.0 / (frame_rate * step) * (1.0 + 1e-9));
  if (!(substeps <= max_substeps)) return std::nullopt;
  return std::max(1, static_cast<int>(substeps));
}

Advice advise(const Spectrum& spectrum, const Settings& settings) {
  const Integrator& method = *settings.integrator;
  if (const auto substeps = min_stable_substeps(method, spectrum, settings.frame_rate)) {
    if (settings.substeps < *substeps) return {&method, *substeps};
    // within the limit already, what grew was not a linear mode along the springs: a smaller step all the same. But a
    // method that lets every undamped mode grow does so with what swings across the springs, where dashpots do nothing
    if (method.stability != Stability::None) return {&method, std::min(max_substeps, 4 * settings.substeps)};
  }
  const Integrator& fallback = default_integrator();
  if (const auto substeps = min_stable_substeps(fallback, spectrum, settings.frame_rate)) return {&fallback, *substeps};
  // more than there may be
  return {&stiff_integrator(), settings.substeps};
}

std::optional<std::string> step_warning(const System& system, const Settings& settings) {
  const Spectrum spectrum = bound_spectrum(system);
  if (settings.substep() <= largest_stable_step(*settings.integrator, spectrum)) return std::nullopt;

  const Advice advice = advise(spectrum, settings);
  const std::string id(settings.integrator->id);
  const std::string needed = std::to_string(advice.substeps) + (advice.substeps == 1 ? " substep" : " substeps") + " a frame";
  if (advice.integrator == settings.integrator)
    return "simulation.substeps: " + std::to_string(settings.substeps) + ": may be too few for " + id + " here: " + needed +
           " hold for certain";
  return "simulation.integrator: " + describe_instability(*settings.integrator, id + ":") + " here: " + std::string(advice.integrator->id) +
         " with " + needed + " does";
}

std::string explain(const Divergence& divergence, const System& system, const Settings& settings, const Advice& advice) {
  const std::string when = "Stopped at t = " + format("%.4g", divergence.time) + " s: ";
  std::string what;
  switch (divergence.kind) {
    case Divergence::Kind::NotFinite:
      what = describe_location(divergence, system) + " went beyond all numbers.";
      break;
    case Divergence::Kind::EnergyGain:
      what = "energy came from nowhere (" + ratio(divergence.energy / divergence.scale) + " times what was put in), first at " +
             describe_location(divergence, system) + ".";
      break;
    case Divergence::Kind::Implausible:
      what = describe_location(divergence, system) + " is " + ratio(divergence.distance) +
             " m away, farther than any motion can have taken it.";
      break;
  }

  const std::string now = std::string(settings.integrator->label) + " with " + std::to_string(settings.substeps) +
                          (settings.substeps == 1 ? " substep" : " substeps");
  const std::string needed = std::to_string(advice.substeps) + (advice.substeps == 1 ? " substep" : " substeps");
  if (advice.integrator != settings.integrator)
    return when + what + " " + describe_instability(*settings.integrator, settings.integrator->label) + " here; " +
           std::string(advice.integrator->label) + " holds with " + needed + " a frame.";
  return when + what + " " + now + " a frame is too coarse: " + needed + " would hold.";
}

}  // namespace hooke
