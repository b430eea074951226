#include "formats/stable_stepping.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "base/file_limits.h"
#include "scene/diagnosis.h"
#include "sim/integrator.h"
#include "sim/plan.h"

namespace hooke {

std::optional<std::string> choose_stable_stepping(Scene& scene, int min_substeps, double forces_omega) {
  Settings& settings = scene.settings;
  Spectrum spectrum = bound_spectrum(scene.system);
  spectrum.omega = std::hypot(spectrum.omega, forces_omega);
  const Integrator& verlet = *find_integrator("velocity_verlet");
  const auto stable_substeps = min_stable_substeps(verlet, spectrum, settings.frame_rate);

  // the limit holds for the scene as it is: some room for springs that a person makes stiffer
  constexpr double safety_factor = 1.25;
  constexpr int max_affordable_substeps = 5000;
  settings.integrator = &verlet;
  if (stable_substeps && safety_factor * *stable_substeps <= max_affordable_substeps) {
    settings.substeps = std::max(min_substeps, static_cast<int>(std::ceil(safety_factor * *stable_substeps)));
    return std::nullopt;
  }

  // an implicit step is worth thousands of explicit ones
  for (const std::string_view id : {"tr_bdf2", "implicit_midpoint", "implicit_euler"}) {
    const Integrator* implicit = find_integrator(id);
    if (!implicit) continue;
    const auto implicit_substeps = min_stable_substeps(*implicit, spectrum, settings.frame_rate);
    if (!implicit_substeps || *implicit_substeps > max_affordable_substeps) continue;
    settings.integrator = implicit;
    settings.substeps = std::max(min_substeps, *implicit_substeps);
    return std::nullopt;
  }

  if (stable_substeps) {
    settings.substeps = std::max(min_substeps, *stable_substeps);
    return "its springs are so stiff that it takes " + std::to_string(*stable_substeps) + " substeps a frame: it will run slowly";
  }
  settings.substeps = max_substeps;
  return "its springs are so stiff that no step holds: expect it to blow up";
}

}  // namespace hooke
