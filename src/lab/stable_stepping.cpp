#include "lab/stable_stepping.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "lab/diagnosis.h"
#include "lab/file_limits.h"
#include "sim/integrator.h"
#include "sim/plan.h"

namespace hooke {

std::optional<std::string> choose_stable_stepping(Scene& scene, int least_substeps, double forces_omega) {
  Settings& settings = scene.settings;
  Spectrum spectrum = bound_spectrum(scene.system);
  spectrum.omega = std::hypot(spectrum.omega, forces_omega);
  const Integrator& verlet = *find_integrator("velocity_verlet");
  const auto fewest = fewest_stable_substeps(verlet, spectrum, settings.frame_rate);

  // the limit holds for the scene as it is: some room for springs that a person makes stiffer
  constexpr double room = 1.25;
  constexpr int most_affordable = 5000;
  settings.integrator = &verlet;
  if (fewest && room * *fewest <= most_affordable) {
    settings.substeps = std::max(least_substeps, static_cast<int>(std::ceil(room * *fewest)));
    return std::nullopt;
  }

  // an implicit step is worth thousands of explicit ones
  for (const std::string_view id : {"tr_bdf2", "implicit_midpoint", "implicit_euler"}) {
    const Integrator* implicit = find_integrator(id);
    if (!implicit) continue;
    const auto needed = fewest_stable_substeps(*implicit, spectrum, settings.frame_rate);
    if (!needed || *needed > most_affordable) continue;
    settings.integrator = implicit;
    settings.substeps = std::max(least_substeps, *needed);
    return std::nullopt;
  }

  if (fewest) {
    settings.substeps = std::max(least_substeps, *fewest);
    return "its springs are so stiff that it takes " + std::to_string(*fewest) + " substeps a frame: it will run slowly";
  }
  settings.substeps = most_substeps;
  return "its springs are so stiff that no step holds: expect it to blow up";
}

}  // namespace hooke
