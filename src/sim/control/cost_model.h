// The cost of stepping, from counts of work. The figures were fitted to measurements on one machine (docs/evidence/accuracy.md) and are the
// same on every other, so that choices which follow from them are too; only their ratios matter.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

class CostModel {
 public:
  explicit CostModel(const Plan& plan);
  // [ms], of the work counted in a motion that this method computed in so many substeps.
  double of(const Integrator& method, const Motion& motion, int substeps) const;
  // [ms], of a frame with this many substeps, before anything is known about it: implicit methods with the iterations that easy frames
  // take.
  double expected(const Integrator& method, int substeps) const;

 private:
  double evaluation(const Integrator& method) const;

  double force_ = 0.0, sweep_ = 0.0, dashpots_ = 0.0, factorization_ = 0.0, solve_ = 0.0;  // [ns]
  double substep_ = 0.0;  // [ns], of a substep: the energy of listed forces, and the search for springs at the strain limit
  double limit_sweep_ = 0.0, expected_limit_ = 0.0;  // [ns], of that limit: of a sweep, and of a substep
  double contact_ = 0.0, expected_contact_ = 0.0;    // [ns], of a substep: for each point, and with what touches before that is known
};

}  // namespace hooke
