#include "sim/methods/precision.h"

#include "sim/methods/integrator.h"

namespace hooke {

std::string needs_double_precision(const Plan& plan, const Settings& settings) {
  if (settings.integrator->steps == nullptr) return "methods but velocity_verlet, velocity_verlet_explicit and symplectic_euler";
  if (plan.has_dashpots()) return "springs with dashpots";
  if (plan.spring.grids.empty()) return "scenes of less than 256 springs, or without a grid";
  if (!plan.spring.loose_runs.empty()) return "springs that are not part of a grid";
  if (plan.has_contact()) return "contact";
  if (!plan.spring.laws.empty()) return "springs with a law";
  if (!plan.forces.empty()) return "listed forces";
  if (!plan.spring.break_length.empty() || !plan.spring.max_length.empty()) return "breaking springs and the strain limit";
  if (plan.hand.held || plan.hand.pull) return "a grab";
  return {};
}

}  // namespace hooke
