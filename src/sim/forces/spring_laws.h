// Springs with a law (model/spring_law.h), one by one: they are few. A scene without them computes nothing here.
#pragma once

#include "sim/forces/dashpots/dashpot.h"
#include "sim/plan/plan.h"

namespace hooke {

// Of any packed spring at this length; `damping` [N s/m] is that of a dashpot that acts.
struct PackedResponse {
  SpringResponse of;
  double damping = 0.0;
};
inline PackedResponse response_of(const LawSpring& spring, const MuscleClock& clock, double time, double length) {
  const double rest_length = rest_length_at(spring.law, spring.rest_length, clock.at(time)).length;
  const SpringResponse response = response_of(spring.law, spring.stiffness, length - rest_length);
  return {response, response.acts ? spring.damping : 0.0};
}
inline PackedResponse response_of(const Plan& plan, Index packed, double time, double length) {
  const LawSprings& laws = plan.spring.laws;
  if (!laws.empty() && laws.of_packed[packed] != no_index)
    return response_of(laws.springs[laws.of_packed[packed]], laws.clock, time, length);
  const double k = plan.spring.stiffness[packed], extension = length - plan.spring.rest_length[packed];
  return {{k * extension, k, 0.5 * k * extension * extension, true}, plan.has_dashpots() ? plan.spring.damping[packed] : 0.0};
}

// Adds their forces [N], with dashpots at the velocities v unless it is null.
void add_law_forces(const Plan& plan, double time, const double* x, const double* v, double* f);

// [J], that they store.
double law_energy(const Plan& plan, double time, const Field& x);
// [W], that their dashpots dissipate.
double law_dashpot_power(const Plan& plan, double time, const Field& x, const Field& v);
// [W], that muscles and winches supply: -T dl0/dt of each.
double muscle_power(const Plan& plan, double time, const Field& x);

// Their dashpots alone over `duration` [s], each exactly (dashpots/dashpot.h).
void sweep_law_dashpots(const Plan& plan, SweepDirection sweep, double duration, double time, const Field& x, Field& v);

// As compliant constraints (methods/xpbd.cpp): the law is linearized at x + h v, at `time`, the end of the step. A spring that does not act
// there has no impulse.
void project_laws(const Plan& plan, double h, double phi, double time, const Field& x, Field& v);

}  // namespace hooke
