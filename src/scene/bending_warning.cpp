#include "scene/bending_warning.h"

#include <algorithm>

#include "sim/forces/hinges.h"
#include "sim/forces/terms/rows.h"

namespace hooke {

std::optional<std::string> bending_warning(const System& system) {
  const auto bends = [](const Force& force) { return force.on && force.term == &bending_force; };
  if (std::ranges::none_of(system.forces, bends)) return std::nullopt;
  if (system.dimensions == 2) return "forces: bending: acts in scenes of 3 dimensions only: this one has 2";
  if (system.faces.empty()) return "forces: bending: acts on faces only: this scene has none";
  const std::size_t hinged = plan_hinges(system).faces.size(), faces = system.faces.size();
  if (hinged == faces) return std::nullopt;
  return "forces: bending: acts on " + std::to_string(hinged) + " of the " + std::to_string(faces) +
         " faces: the others share no edge with exactly one other, or have springs along fewer than two edges";
}

}  // namespace hooke
