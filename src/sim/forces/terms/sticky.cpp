// A point that touches a plane stays there until the sum of the other forces pulls it off with more than s [N]. What is held is decided at
// the start of a step, and remains so up to its end (sticking.h). So the force is continuous within a step, whatever the stages of the
// method evaluate.
#include <algorithm>

#include "sim/forces/terms/rows.h"
#include "sim/forces/terms/sticking.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {{"strength", "Stickiness", "N", 0.0, 1000.0, 1.0}};

// What presses is left to contact, for its friction.
void add(const Plan& plan, const ForceValues&, double time, const double*, const double*, double* f) {
  for (const StickyContact& contact : plan.force_data.sticky.held) {
    const double pull = pull_on(plan, contact, time, f);
    if (pull > 0.0) add_vector(plan, f, contact.point, -pull * normal_of(plan, contact));
  }
}

// The force projects the derivative of the other forces, whose eigenvalues do not grow by that; it has no derivative of its own. What it
// works on planes that move is that of the colliders (sticking.h).
ForceBound bound(const System&, const Plan&, const ForceValues&, double) { return {}; }

void prepare(const System& system, Plan& plan) {
  for (const Force& force : system.forces)
    if (force.on && force.term == &sticky_force)
      plan.force_data.sticky.strength = std::max(plan.force_data.sticky.strength, force.values[0]);
}

}  // namespace

constinit const ForceTerm sticky_force{
    .id = "sticky",
    .rank = 7,
    .label = "Sticky walls",
    .description = "Holds a point on a plane that it touches until a larger force pulls it off.",
    .numbers = numbers,
    .is_continuous = false,
    .add = add,
    .bound = bound,
    .prepare = prepare,
};

}  // namespace hooke
