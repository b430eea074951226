// What acts in a state: the forces of springs, of nails and from outside.
#pragma once

#include <vector>

#include "lab/lab.h"

namespace hooke {

struct Loads {
  // of each spring, without its dashpot: tension [N], negative in compression, and energy [J]
  std::vector<double> tension, energy;
  // of each point [N]: gravity, wind and listed forces; the force of the nail or the hand that keeps it in place, zero for free points; and
  // that of contact, which is in neither: the mean of its impulses over the last frame, zero before the first one
  std::vector<Vec3> external, reaction, contact;
};

Loads compute_loads(const Lab& lab);

}  // namespace hooke
