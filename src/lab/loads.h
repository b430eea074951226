// What acts in a state: the forces of springs, of nails and from outside.
#pragma once

#include <vector>

#include "sim/plan/plan.h"

namespace hooke {

struct Loads {
  // of each spring, without its dashpot: tension [N], negative in compression, and energy [J]
  std::vector<double> tension, energy;
  // of each point [N]: gravity, wind and listed forces; and the force of the nail or the hand that keeps it in place, zero for free points.
  // Contact, which acts by impulses, is in neither.
  std::vector<Vec3> external, reaction;
};

Loads compute_loads(const Plan& plan, const System& system, const State& state);

}  // namespace hooke
