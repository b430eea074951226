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
// The last of these alone.
std::vector<Vec3> contact_forces(const Lab& lab);

// A point that touched something in the last frame: the mean force [N] on it, and the part of the scene that it most probably touched, the
// nearest in the direction of the force in the present state, by its number in its list, with the normal towards the point.
struct Contact {
  enum class Partner { Unknown, Collider, Point, Spring, Face };
  Index point = 0;
  Vec3 force{0.0};
  Partner partner = Partner::Unknown;
  Index number = no_index;
  Vec3 normal{0.0};
};

// In ascending order of the points.
std::vector<Contact> find_contacts(const Lab& lab);

}  // namespace hooke
