#include "scene/warnings/pressure_warning.h"

#include <algorithm>

#include "sim/forces/terms/rows.h"
#include "sim/plan/enclosures.h"

namespace hooke {

std::optional<std::string> pressure_warning(const System& system) {
  const auto presses = [](const Force& force) { return force.on && force.term == &pressure_force; };
  if (std::ranges::none_of(system.forces, presses)) return std::nullopt;
  const EnclosurePlan plan = plan_enclosures(system);
  const std::size_t closed = plan.enclosures.size(), all = closed + static_cast<std::size_t>(plan.open);
  const bool is_flat = system.dimensions == 2;
  const std::string surfaces = is_flat ? "closed lines of springs" : "closed surfaces of faces";
  if (all == 0) return "forces: pressure: fills " + surfaces + " only: this scene has none";
  if (plan.open == 0) return std::nullopt;
  return "forces: pressure: fills " + std::to_string(closed) + " of the " + std::to_string(all) +
         (is_flat ? " sets of faces: the others have an edge of more than two faces, no springs along their border, or rest lengths that "
                    "enclose nothing"
                  : " surfaces: the others have edges that do not belong to exactly two faces, or faces whose springs are missing or have "
                    "rest lengths that form no triangle");
}

}  // namespace hooke
