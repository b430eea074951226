#include "scene/warnings/warnings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/number_text.h"
#include "sim/forces/terms/rows.h"
#include "sim/plan/enclosures.h"
#include "sim/plan/hinges.h"
#include "sim/plan/rest_faces.h"

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

std::optional<std::string> rest_angle_warning(const System& system) {
  const auto angle = [&](const FaceEdge& edge) { return system.faces[edge.face].rest_angle[edge.corner]; };
  const auto name_of = [](const FaceEdge& edge) {
    return "rest_angles[" + std::to_string(edge.face) + "][" + std::to_string(edge.corner) + "]";
  };
  constexpr double round_off = 1e-9;

  std::size_t count = 0;
  std::optional<std::string> first_of_them;
  for_each_edge(sorted_edges(system), [&](std::span<const FaceEdge> same) {
    if (same.size() != 2 || same[0].opposite == same[1].opposite) return;
    const FaceEdge &first = same[0], &second = same[1];
    // faces with opposite normals see opposite angles
    const double expected = first.from == second.from ? -angle(first) : angle(first);
    if (std::abs(std::remainder(angle(second) - expected, 2.0 * std::numbers::pi)) <= round_off) return;
    if (count++ == 0)
      first_of_them = name_of(second) + ": " + quantity_text(angle(second), "rad", 3) + ": " + name_of(first) + " means " +
                      quantity_text(expected, "rad", 3) + " at the same edge: bending \"as_built\" rests between both";
  });
  if (count > 1) *first_of_them += " (the first of " + std::to_string(count) + " such edges)";
  return first_of_them;
}

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

std::optional<std::string> strain_limit_warning(const System& system, const State& state) {
  constexpr double min_excess = 1.01;  // of the length, from which on energy is not conserved (sim/forces/spring_limits.cpp)
  if (!(system.strain_limit > 0.0)) return std::nullopt;
  std::size_t count = 0, index = 0;
  std::string first;
  for (const Spring& spring : system.springs()) {
    const std::size_t s = index++;
    if (!system.is_on(spring) || !(spring.rest_length > 0.0)) continue;
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const double length = glm::distance(state.position[i], state.position[j]), max = spring.rest_length * (1.0 + system.strain_limit);
    if (!(length > min_excess * max) || (system.points()[i].nailed && system.points()[j].nailed) || count++ != 0) continue;
    first = "spring " + std::to_string(s) + " (points " + std::to_string(i) + " and " + std::to_string(j) + ") starts " +
            quantity_text(length, "m", 3) + " long, where the limit is " + quantity_text(max, "m", 3);
  }
  if (count == 0) return std::nullopt;
  if (count > 1) first += " (the first of " + std::to_string(count) + " such springs)";
  return "strain_limit_percent: " + quantity_text(100.0 * system.strain_limit, "%", 3) + ": " + first +
         ": the first substep shortens it at once";
}

}  // namespace hooke
