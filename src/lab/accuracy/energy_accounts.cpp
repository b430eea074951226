#include "lab/accuracy/energy_accounts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/forces/energy/energy.h"

namespace hooke {
namespace {

// [W], of drag in air at rest, because what wind does is work of a force.
double drag_power(const System& system, const State& state) {
  const double rate = system.drag_rate();
  double power = 0.0;
  for (Index i = 0; rate > 0.0 && i < system.point_count(); ++i) {
    const Point& point = system.points()[i];
    if (!point.nailed) power += rate * point.mass * glm::dot(state.velocity[i], state.velocity[i]);
  }
  return power;
}

// [W], of the springs that are not broken.
double dashpot_power(const System& system, const State& state, const std::vector<BrokenSpring>& breaks = {}) {
  std::vector<bool> is_broken(breaks.empty() ? 0 : static_cast<std::size_t>(system.spring_count()));
  for (const BrokenSpring& broken : breaks) is_broken[static_cast<std::size_t>(broken.spring)] = true;
  double power = 0.0;
  for (Index s = 0; s < system.spring_count(); ++s)
    if (breaks.empty() || !is_broken[static_cast<std::size_t>(s)]) power += dashpot_power(system, state, system.springs()[s]);
  return power;
}

// [W], sum of the powers at the start of the frame and at its end. Of a spring that breaks within the frame, those at the start and at the
// break, with which the trapezoidal rule over the whole frame gives what its dashpot dissipates until then.
double dashpot_powers(const System& system, const State& before, const State& after, double start, double end,
                      const std::vector<BrokenSpring>& breaks) {
  double sum = start + end;
  for (const BrokenSpring& broken : breaks) {
    const double power = dashpot_power(system, before, system.springs()[broken.spring]);
    sum += (broken.time - before.time) / (after.time - before.time) * (power + broken.dashpot_power) - power;
  }
  return std::max(0.0, sum);
}

}  // namespace

void EnergyAccounts::start(const State& state, double energy) {
  balance_ = {.since = state.time};
  start_ = energy_ = energy;
  net_input_ = state.ledger.net_input;
  rest_ = repeated_rest_ = gain_ratio_ = dissipation_ = resolved_ = repeated_resolved_ = 0.0;
  is_resolved_ = false;
  power_.reset();
}

void EnergyAccounts::note_edit() {
  power_.reset();
  bound_ = {};
}

void EnergyAccounts::set_numerical_gain(double gain) {
  constexpr double max_ratio = 2.0;  // 1.5 in the first frame of a motion that starts from rest
  dissipation_ = std::min(0.0, repeated_rest_ - gain);
  is_resolved_ = max_ratio * repeated_resolved_ <= dissipation_ && repeated_resolved_ >= max_ratio * dissipation_;
  gain_ratio_ = dissipation_ < 0.0 ? (repeated_rest_ - dissipation_) / dissipation_ : std::numeric_limits<double>::infinity();
}

// Where the frames resolve the motion, so that the powers at the ends of the repeated frame agree with what was dissipated in it, those at
// the ends of this one say what is dissipated here. Vibrations that they do not resolve decay, and gain and dissipation keep their ratio as
// they do. It determines neither if they nearly cancel: then the dissipation of the repeated frame applies. Drag and dashpots never supply
// energy, and dissipate at most `max` [J].
double EnergyAccounts::dissipation_in(double rest, double max) const {
  constexpr double min_determined = 0.1;
  if (is_resolved_) return std::clamp(resolved_, -max, 0.0);
  return std::clamp(1.0 + gain_ratio_ > min_determined ? rest / (1.0 + gain_ratio_) : dissipation_, -max, 0.0);
}

void EnergyAccounts::add_frame(const Plan& plan, const System& system, const State& before, const State& after, const Motion& motion,
                               double energy) {
  // the ledger of the state before the frame contains the edits since the last one
  const double edits = before.ledger.net_input - net_input_;
  balance_.edits += edits;
  balance_.hand += motion.hand_work;
  balance_.forces += motion.force_work;
  balance_.colliders += motion.collider_work;
  // what a strain limit cannot have supplied is an error of the method
  balance_.limits += motion.break_work + motion.limit_work - motion.limit_gain;
  // What contact or dashpots supply balances what the method has lost on a path that contact takes back, or is an error of the method.
  // Frame by frame: in total, it would hide what they have dissipated before.
  const double by_contact = std::min(0.0, motion.contact_work);
  balance_.contact += by_contact;

  // the remainder is due to the method, or to the drag and the dashpots of the scene
  const double supplied = after.ledger.net_input - net_input_ - motion.limit_gain;
  const double rest = energy - energy_ - supplied - by_contact;
  rest_ = rest;
  const bool drags = system.drag_rate() > 0.0, damps = plan.has_dashpots();
  if (!drags && !damps) {
    balance_.method += rest;
  } else if (motion.measures_damping) {
    // in every substep: nothing has to be estimated from the ends of the frame
    const double by_dashpots = std::min(0.0, motion.dashpot_work);
    resolved_ = motion.drag_work + by_dashpots;
    balance_.drag += motion.drag_work;
    balance_.dashpots += by_dashpots;
    balance_.method += rest - resolved_;
    power_.reset();
  } else {
    if (!power_) power_ = {drag_power(system, before), dashpot_power(system, before)};
    const Dissipation start = *power_;
    power_ = {drag_power(system, after), dashpot_power(system, after, motion.breaks)};
    const double by_drag = start.drag + power_->drag;
    const double by_dashpots = dashpot_powers(system, before, after, start.dashpots, power_->dashpots, motion.breaks);
    resolved_ = -0.5 * (after.time - before.time) * (by_drag + by_dashpots);
    const double drag_fraction = by_drag + by_dashpots > 0.0 ? by_drag / (by_drag + by_dashpots) : drags ? 1.0 : 0.0;
    bound_.begin_frame(system, before);
    const double dissipated = dissipation_in(rest, bound_.end_frame(plan, system, after, motion));
    balance_.method += rest - dissipated;
    balance_.drag += drag_fraction * dissipated;
    balance_.dashpots += (1.0 - drag_fraction) * dissipated;
  }
  balance_.change = energy - start_;
  energy_ = energy;
  net_input_ = after.ledger.net_input;
}

}  // namespace hooke
