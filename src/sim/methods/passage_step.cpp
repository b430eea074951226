#include "sim/methods/passage_step.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "sim/forces/energy/energy.h"
#include "sim/methods/integrator.h"
#include "sim/model/force_term.h"
#include "sim/model/portable_math.h"
#include "sim/model/settings.h"

namespace hooke {

double longest_step(const Passage& passage, const Integrator& integrator) {
  if (integrator.stability == Stability::Adaptive || integrator.step == nullptr) return std::numeric_limits<double>::infinity();
  return passage.longest_step(integrator.order, integrator.order == 1 && integrator.stability == Stability::LStable);
}

Passage shortest_passage(const System& system, const State& state, double within) {
  Passage shortest;
  const auto is_on = [](const Force& force) { return force.on; };
  const auto passes = [](const Force& force) { return force.on && force.term->passage != nullptr; };
  if (std::ranges::none_of(system.forces, passes)) return shortest;

  std::vector<double> elastic(static_cast<std::size_t>(system.point_count()), 0.0);  // [J]
  std::vector<bool> has_springs(elastic.size());
  for (const Spring& spring : system.springs()) {
    const double energy = elastic_energy(system, state, spring);
    for (const PointId id : {spring.first, spring.second}) {
      const auto i = static_cast<std::size_t>(system.index_of(id));
      elastic[i] += energy;
      has_springs[i] = true;
    }
  }
  const double gravity = glm::length(system.gravity);
  const bool other_forces = gravity > 0.0 || system.drag_rate() > 0.0 || has_contact(system) || system.grab || system.scripted_hand ||
                            std::ranges::count_if(system.forces, is_on) > 1;
  double step = std::numeric_limits<double>::infinity();
  for (const Force& force : system.forces) {
    if (!passes(force)) continue;
    for (Index i = 0; i < system.point_count(); ++i) {
      const Point& point = system.points()[i];
      if (point.nailed) continue;
      const Passage passage = force.term->passage(force.values, {.system = system,
                                                                 .force = force,
                                                                 .position = state.position[i],
                                                                 .velocity = state.velocity[i],
                                                                 .gravity = gravity,
                                                                 .elastic = elastic[i] / point.mass,
                                                                 .is_alone = !other_forces && !has_springs[i],
                                                                 .within = within});
      if (const double longest = longest_step(passage, default_integrator()); longest < step) {
        step = longest;
        shortest = passage;
      }
    }
  }
  return shortest;
}

}  // namespace hooke
