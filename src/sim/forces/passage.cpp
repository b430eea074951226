#include "sim/forces/passage.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/energy.h"
#include "sim/forces/force_term.h"
#include "sim/integrator.h"
#include "sim/portable_math.h"
#include "sim/settings.h"

namespace hooke {

double PassingPoint::supplied_by_others(const Vec3& place) const {
  double supplied = 0.0;
  for (const Force& other : system.forces)
    if (other.on && &other != &force && other.term->potential_at != nullptr)
      supplied += other.term->potential_at(system, other.values, position) - other.term->potential_at(system, other.values, place);
  return std::max(0.0, supplied);
}

double longest_step(const Passage& passage, const Integrator& integrator) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (!(passage.speed > 0.0) || integrator.stability == Stability::Adaptive || integrator.step == nullptr) return none;

  // With n steps in the time length / speed, a passage through a center changes the energy by at most n^-3 / 30 of the kinetic energy
  // there, from n = 3 on, with methods of any order: the law of the force has a jump in its second derivative. At a plane it has one in the
  // first, and the change is up to n^-2 / 10. In between, methods of first order let it oscillate by some 1 / n; those of them that
  // dissipate take 0.6 / n of it. Measured for exponents of 0.5 to 4 (tests/study/passage_test.cpp).
  const double depth = std::max(1.0, 0.5 * passage.speed * passage.speed / passage.energy);
  const bool dissipates = integrator.order == 1 && integrator.stability == Stability::LStable;
  const double steps = dissipates ? 60.0 * depth : (integrator.order == 1 ? 15.0 : 3.0) * portable::pow(depth, 1.0 / passage.exponent);
  const double resolved = passage.length / (steps * passage.speed);

  // a force so weak against the motion that one step in it, wherever it is, changes the energy little
  constexpr double max_change = 0.01;
  return std::max(resolved, max_change * passage.energy / (passage.acceleration * passage.speed));
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
                                                                 .radius = point.radius,
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
