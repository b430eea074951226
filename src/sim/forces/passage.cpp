#include "sim/forces/passage.h"

#include <algorithm>
#include <limits>

#include "sim/forces/constants.h"
#include "sim/model/force_term.h"
#include "sim/model/portable_math.h"

namespace hooke {

double PassingPoint::supplied_by_others(const Vec3& place) const {
  double supplied = 0.0;
  for (const Force& other : system.forces)
    if (other.on && &other != &force && other.term->potential_at != nullptr)
      supplied += other.term->potential_at(system, other.values, position) - other.term->potential_at(system, other.values, place);
  return std::max(0.0, supplied);
}

double Passage::longest_step(int order, bool dissipates) const {
  if (!(speed > 0.0)) return std::numeric_limits<double>::infinity();

  // With n steps in the time length / speed, a passage through a center changes the energy by at most n^-3 / 30 of the kinetic energy
  // there, from n = 3 on, with methods of any order: the law of the force has a jump in its second derivative. Methods of first order let
  // it oscillate by some 1 / n; those of them that dissipate take 0.6 / n of it. Measured for exponents of 0.5 to 4
  // (tests/study/passage_test.cpp).
  const double depth = std::max(1.0, 0.5 * speed * speed / energy);
  const double steps = dissipates ? 60.0 * depth : (order == 1 ? 15.0 : 3.0) * portable::pow(depth, 1.0 / 3.0);
  const double resolved = length / (steps * speed);

  // a force so weak against the motion that one step in it, wherever it is, changes the energy little
  return std::max(resolved, max_unresolved_change * energy / (acceleration * speed));
}

}  // namespace hooke
