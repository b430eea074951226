#include "study/companion_settings.h"

#include <algorithm>

#include "base/number_text.h"
#include "sim/control/automatic.h"
#include "sim/methods/integrator.h"
#include "sim/model/bounding_box.h"

namespace hooke {

Companion companion_of(const Settings& settings) {
  const std::string name = settings.integrator->short_name();
  const bool adapts = settings.integrator->stability == Stability::Adaptive;
  return {.name = name + ", " +
                  (is_automatic(settings) ? "tolerance " + quantity_text(automatic_tolerance(settings), "m/s", 1)
                   : adapts               ? "tolerance " + quantity_text(settings.tolerance.value_or(default_tolerance), "m", 1)
                                          : std::to_string(settings.substeps) + (settings.substeps == 1 ? " substep" : " substeps")),
          .settings = settings};
}

Companion reference_companion(const State& state, const Settings& settings) {
  Settings reference = settings;
  reference.integrator = find_integrator("dop853");
  reference.substeps = 1;
  reference.tolerance = 1e-9 * std::max(bounding_box(state.position).longest_side(), 1e-6);
  return {.name = "Reference (" + std::string(reference.integrator->id) + ", " + quantity_text(*reference.tolerance, "m", 1) + ")",
          .settings = reference};
}

}  // namespace hooke
