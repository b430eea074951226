#include "sim/forces/spring_limits.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/forces/constants.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/spring_laws.h"

namespace hooke {
namespace {

double squared_length(const Plan& plan, const Field& x, Index first, Index second) {
  double sum = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    const double* at = x.data() + static_cast<std::size_t>(c) * plan.points;
    sum += (at[first] - at[second]) * (at[first] - at[second]);
  }
  return sum;
}

// Whether any spring of the run has reached its limit. If none has, nothing else has to be computed.
bool any_reaches_limit(const Plan& plan, const SpringRun& run, const std::vector<double>& limit, const Field& x) {
  Index count = 0;
  for (Index e = 0; e < run.count; ++e) {
    const double max = limit[run.begin + e];
    count += squared_length(plan, x, run.first + e, run.second + e) >= max * max ? 1 : 0;
  }
  return count > 0;
}

// [J], without the energy of the hand and the listed forces.
double energy_of(const Plan& plan, const Motion& motion) {
  return kinetic_energy(plan, motion.v) + stored_energy(plan, motion.time, motion.x);
}

// Moves the ends of one spring to the distance `max` and stops their separation. As the distance decreases, they rotate faster about their
// common center, so that l times the transverse velocity is conserved and a swing loses nothing. This does not apply to a spring that is
// far too long after a step that was too coarse, because the ends would be accelerated in every round. A roller takes only its part of what
// would move a free point, so that further rounds are needed.
void limit_spring(const Plan& plan, Motion& motion, Index first, Index second, double length, double max) {
  const double w1 = plan.inverse_mass[first], w2 = plan.inverse_mass[second];
  if (w1 + w2 == 0.0) return;
  const Vec3 along = difference_at(plan, motion.x, first, second) / length, separation = difference_at(plan, motion.v, first, second);
  const double speed = glm::dot(along, separation), rotation_gain = length < max_conserving_ratio * max ? length / max - 1.0 : 0.0;
  const Vec3 correction = (length - max) / (w1 + w2) * along;
  const Vec3 impulse = (std::max(0.0, speed) * along - rotation_gain * (separation - speed * along)) / (w1 + w2);
  add_vector(plan, motion.x, first, free_part(plan, first, w1 * correction));
  add_vector(plan, motion.x, second, free_part(plan, second, -w2 * correction));
  add_vector(plan, motion.v, first, free_part(plan, first, w1 * impulse));
  add_vector(plan, motion.v, second, free_part(plan, second, -w2 * impulse));
}

// One round over all springs. Returns whether any was too long.
bool limit_all_springs(const Plan& plan, Motion& motion) {
  bool any = false;
  for (const SpringRun& run : plan.spring.runs) {
    if (!any_reaches_limit(plan, run, plan.spring.max_length, motion.x)) continue;
    for (Index e = 0; e < run.count; ++e) {
      const double max = plan.spring.max_length[run.begin + e];
      const double length = std::sqrt(squared_length(plan, motion.x, run.first + e, run.second + e));
      if (!(length > max * (1.0 + limit_tolerance)) || !std::isfinite(length)) continue;
      limit_spring(plan, motion, run.first + e, run.second + e, length, max);
      any = true;
    }
  }
  return any;
}

// Where springs cannot be as short as they must be, because nails, the hand or other springs keep their ends apart, forces would accelerate
// points that the limit moves back again and again, and supply energy without end. The ends of such springs move together instead.
void stop_overlong_springs(const Plan& plan, Motion& motion) {
  const auto stop = [&](Index first, Index second, Index spring) {
    const double length = std::sqrt(squared_length(plan, motion.x, first, second)), w1 = plan.inverse_mass[first],
                 w2 = plan.inverse_mass[second];
    if (!(length > max_conserving_ratio * plan.spring.max_length[spring]) || !std::isfinite(length) || w1 + w2 == 0.0) return;
    const Vec3 impulse = difference_at(plan, motion.v, first, second) / (w1 + w2);
    add_vector(plan, motion.v, first, free_part(plan, first, w1 * impulse));
    add_vector(plan, motion.v, second, free_part(plan, second, -w2 * impulse));
  };
  for_each_spring(plan, stop);
  for (auto run = plan.spring.runs.rbegin(); run != plan.spring.runs.rend(); ++run)
    for (Index e = run->count; e-- > 0;) stop(run->first + e, run->second + e, run->begin + e);
}

// [m/s], of the ends of a spring of this length, which is not 0.
double separation_speed(const Plan& plan, const Motion& motion, Index first, Index second, double length) {
  return glm::dot(difference_at(plan, motion.x, first, second), difference_at(plan, motion.v, first, second)) / length;
}

}  // namespace

bool carries_force(const Plan& plan, Index spring) {
  const LawSprings& laws = plan.spring.laws;
  if (!laws.empty() && laws.of_packed[spring] != no_index) return laws.springs[laws.of_packed[spring]].acts();
  return plan.spring.stiffness[spring] != 0.0 || (plan.has_dashpots() && plan.spring.damping[spring] > 0.0);
}

double time_to_break(const Plan& plan, const Motion& motion) {
  double min = std::numeric_limits<double>::infinity();
  if (plan.spring.break_length.empty()) return min;
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const double limit = plan.spring.break_length[s];
    const double length = std::sqrt(squared_length(plan, motion.x, i, j));
    if (!std::isfinite(limit) || !carries_force(plan, s) || !(length < limit) || length == 0.0) return;
    const double speed = separation_speed(plan, motion, i, j, length);
    if (speed > 0.0) min = std::min(min, (limit - length) / speed);
  });
  return min;
}

void break_spring(Plan& plan, Motion& motion, Index spring, double length, std::vector<Index>& broken) {
  ++motion.counts.breaks;
  motion.energy.add(EnergyCause::Breaks, -response_of(plan, spring, motion.time, length).of.energy);
  if (LawSprings& laws = plan.spring.laws; !laws.empty() && laws.of_packed[spring] != no_index)
    laws.springs[laws.of_packed[spring]].stiffness = laws.springs[laws.of_packed[spring]].damping = 0.0;
  plan.spring.stiffness[spring] = 0.0;
  if (plan.has_dashpots()) plan.spring.damping[spring] = 0.0;
  broken.push_back(plan.spring.index[spring]);
}

bool break_springs(Plan& plan, Motion& motion, std::vector<Index>& broken) {
  const std::size_t before = broken.size();
  for (const SpringRun& run : plan.spring.runs) {
    if (!any_reaches_limit(plan, run, plan.spring.break_length, motion.x)) continue;
    for (Index e = 0; e < run.count; ++e) {
      const Index s = run.begin + e;
      const double length = std::sqrt(squared_length(plan, motion.x, run.first + e, run.second + e));
      if (length >= plan.spring.break_length[s] && carries_force(plan, s)) break_spring(plan, motion, s, length, broken);
    }
  }
  std::sort(broken.begin(), broken.end());
  if (broken.size() == before) return false;
  refresh_grid_stiffness(plan);
  return true;
}

bool limit_strain(const Plan& plan, Motion& motion) {
  const auto is_too_long = [&](const SpringRun& run) { return any_reaches_limit(plan, run, plan.spring.max_length, motion.x); };
  if (std::none_of(plan.spring.runs.begin(), plan.spring.runs.end(), is_too_long)) return false;

  const double before = energy_of(plan, motion);
  bool any = false, is_met = false;
  for (int round = 0; round < max_limit_rounds && !is_met; ++round) {
    ++motion.counts.limit_sweeps;
    is_met = !limit_all_springs(plan, motion);
    any = any || !is_met;
  }
  if (!is_met) stop_overlong_springs(plan, motion);
  if (any) motion.energy.add(EnergyCause::StrainLimit, energy_of(plan, motion) - before);
  return any;
}

}  // namespace hooke
