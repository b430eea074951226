// Limits of the length of springs: breaking, and the strain limit.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// Whether this packed spring does: one that is switched off or broken carries no force and cannot break.
bool carries_force(const Plan& plan, Index spring);

// [s], until a spring that separates reaches the length at which it breaks, at the velocities of this motion; infinity: none does.
double time_to_break(const Plan& plan, const Motion& motion);

// Sets k and d of a packed spring of this length to zero, and adds its index in the System to `broken`. Adds the loss of its elastic energy
// to the energy ledger, and counts it. The grids are refreshed by the caller.
void break_spring(Plan& plan, Motion& motion, Index spring, double length, std::vector<Index>& broken);

// Breaks the springs at least as long as plan.spring.break_length; `broken` is kept in ascending order. Returns whether any broke.
bool break_springs(Plan& plan, Motion& motion, std::vector<Index>& broken);

// Shortens springs longer than plan.spring.max_length, one after another in several rounds, by moving both ends in proportion to their
// inverse masses; ends that still separate are stopped along the spring (X. Provot, Deformation constraints in a mass-spring model,
// Graphics Interface 1995; with the velocities as in an inelastic impact). Conserves linear momentum, and angular momentum when shortening
// by at most 1 %, but not energy: the change is added to the energy ledger. Springs that remain more than 1 % too long, because nails or
// other springs keep their ends apart, stop the motion of their ends relative to each other. Returns whether any spring was too long.
bool limit_strain(const Plan& plan, Motion& motion);

}  // namespace hooke
