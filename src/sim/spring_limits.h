// What springs cannot be stretched beyond: where they break, and where they are held.
#pragma once

#include "sim/motion.h"

namespace hooke {

// Takes k and d from the packed springs that are as long as plan.break_length or longer, and adds them, as the System's, to
// `broken`, which stays in ascending order. What they held is taken off motion.break_work. Returns whether any broke.
bool break_springs(Plan& plan, Motion& motion, std::vector<Index>& broken);

// Shortens springs that are longer than plan.max_length, one after another and again, by moving both ends by their inverse
// masses; ends that still part are stopped along the spring (X. Provot, Deformation constraints in a mass-spring model,
// Graphics Interface 1995; with the velocities as in an inelastic impact). Keeps linear momentum, angular momentum where it shortens
// by 1 % at most, and not energy: what comes of that is added to motion.limit_work. Returns whether any was too long.
bool limit_strain(const Plan& plan, Motion& motion);

}  // namespace hooke
