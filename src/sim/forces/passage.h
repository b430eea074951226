// How fast points pass through the small regions in which listed forces are strongest. The step must resolve that too, and no frequency
// of small oscillations describes it.
#pragma once

#include <limits>

#include "base/types.h"
#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

struct Force;

// A point before its passage through a region of `force`.
struct PassingPoint {
  const System& system;
  const Force& force;
  Vec3 position{0.0}, velocity{0.0};
  double gravity = 0.0;   // [m/s^2]
  double elastic = 0.0;   // [J/kg], of its springs, which it may get as kinetic energy
  bool is_alone = false;  // nothing but this force acts on it, which keeps its angular momentum about the center
  double within = std::numeric_limits<double>::infinity();  // [s], in which the passage must begin to count

  // [J/kg], what the other listed forces supply on the way to this place; 0 where they take energy.
  double supplied_by_others(const Vec3& place) const;
};

// Estimates from the energy of the point, which others do not increase.
struct Passage {
  double speed = 0.0;         // [m/s], the highest; 0: none
  double length = 0.0;        // [m], over which the force changes
  double acceleration = 0.0;  // [m/s^2], by the force there, the highest
  double energy = 0.0;        // [J/kg], of the motion far from there, which is little where a point falls deep

  // [s], the longest step with which a method of this order gets the point through with an energy that is wrong by less than about a
  // hundredth of that of its motion far from there. `dissipates`: a method of first order that damps fast motion.
  double longest_step(int order, bool dissipates) const;
};

}  // namespace hooke
