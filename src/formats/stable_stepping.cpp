#include "formats/stable_stepping.h"

#include <algorithm>
#include <cmath>

#include "base/file_limits.h"
#include "sim/methods/step_limits.h"
#include "sim/plan/plan.h"

namespace hooke {

std::optional<std::string> choose_stable_stepping(Scene& scene, int min_substeps, double forces_omega) {
  Settings& settings = scene.settings;
  Spectrum spectrum = bound_spectrum(scene.system);
  if (!spectrum.is_bounded) spectrum.estimated_omega = std::max(spectrum.estimated_omega, forces_omega);
  const Integrator& explicit_method = default_integrator();
  const StepLimits limits(spectrum);
  const auto stable_substeps = limits.stable_substeps(explicit_method, settings.frame_rate);

  // the limit holds for the current scene: leave a margin for springs that the user makes stiffer
  constexpr double safety_factor = 1.25;
  constexpr int max_affordable_substeps = 5000;
  settings.integrator = &explicit_method;
  if (stable_substeps && safety_factor * *stable_substeps <= max_affordable_substeps) {
    settings.substeps = std::max(min_substeps, static_cast<int>(std::ceil(safety_factor * *stable_substeps)));
    return std::nullopt;
  }

  // an implicit step costs as much as thousands of explicit ones
  const Integrator& implicit_method = stiff_integrator();
  const auto implicit_substeps = limits.stable_substeps(implicit_method, settings.frame_rate);
  if (implicit_substeps && *implicit_substeps <= max_affordable_substeps) {
    settings.integrator = &implicit_method;
    settings.substeps = std::max(min_substeps, *implicit_substeps);
    return std::nullopt;
  }

  if (stable_substeps) {
    settings.substeps = std::max(min_substeps, *stable_substeps);
    return limits.limit_text(explicit_method, settings.frame_rate) + ": it will run slowly";
  }
  settings.substeps = max_substeps;
  return "its springs are so stiff that no step is stable: expect it to blow up";
}

}  // namespace hooke
