#include "lab/accuracy/energy_accounts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/energy.h"

namespace hooke {
namespace {

// The fractions of drag and dashpots are evaluated in one frame in this many, because that visits every spring.
constexpr int fraction_period = 8;

// Powers [W] at a state.
struct Dissipation {
  double drag = 0.0, dashpots = 0.0;
};

Dissipation dissipation_at(const System& system, const State& state) {
  Dissipation power;
  const double rate = system.drag_rate();
  for (Index i = 0; rate > 0.0 && i < system.point_count(); ++i) {
    const Point& point = system.points()[i];
    if (!point.nailed) power.drag += rate * point.mass * glm::dot(state.velocity[i], state.velocity[i] - system.wind);
  }
  for (const Spring& spring : system.springs()) {
    const double damping = system.damping_of(spring);
    if (damping == 0.0) continue;
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const Vec3 along = state.position[j] - state.position[i];
    const double length = glm::length(along);
    if (length == 0.0) continue;
    const double speed = glm::dot(state.velocity[j] - state.velocity[i], along) / length;
    power.dashpots += damping * speed * speed;
  }
  return power;
}

}  // namespace

void EnergyAccounts::start(const State& state, double energy) {
  balance_ = {.since = state.time};
  start_ = energy_ = energy;
  net_input_ = state.ledger.net_input;
  contact_work_ = rest_ = repeated_rest_ = gain_ratio_ = dissipation_ = 0.0;
  frames_since_fraction_ = fraction_period;
}

void EnergyAccounts::set_numerical_gain(double gain) {
  dissipation_ = std::min(0.0, repeated_rest_ - gain);
  gain_ratio_ = dissipation_ < 0.0 ? (repeated_rest_ - dissipation_) / dissipation_ : 0.0;
}

// As the motion decays, gain and dissipation keep their ratio. It determines neither if they nearly cancel: then the dissipation of the
// repeated frame applies. Drag and dashpots never supply energy, and dissipate at most `max` [J].
double EnergyAccounts::dissipation_in(double rest, double max) const {
  constexpr double min_determined = 0.1;
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
  balance_.limits += motion.break_work + motion.limit_work;
  // colliders at rest cannot have supplied energy in total: what they did is an error of the method
  contact_work_ += motion.contact_work;
  const double by_contact = std::min(0.0, contact_work_) - balance_.contact;
  balance_.contact += by_contact;

  // the remainder is due to the method, or to the drag and the dashpots of the scene
  const double supplied = after.ledger.net_input - net_input_;
  double rest = energy - energy_ - supplied - by_contact;
  rest_ = rest;
  const bool drags = system.drag_rate() > 0.0, damps = plan.has_dashpots();
  if (!drags && !damps) {
    balance_.method += rest;
  } else {
    bound_.begin_frame(system, before);
    const double dissipated = dissipation_in(rest, bound_.end_frame(plan, system, after, motion));
    balance_.method += rest - dissipated;
    rest = dissipated;
    if (!drags || !damps) {
      drag_fraction_ = drags ? 1.0 : 0.0;
      frames_since_fraction_ = fraction_period;
    } else if (++frames_since_fraction_ >= fraction_period) {
      frames_since_fraction_ = 0;
      const Dissipation start = dissipation_at(system, before), end = dissipation_at(system, after);
      const double by_drag = std::abs(start.drag + end.drag), by_dashpots = start.dashpots + end.dashpots;
      drag_fraction_ = by_drag + by_dashpots > 0.0 ? by_drag / (by_drag + by_dashpots) : 0.5;
    }
    balance_.drag += drag_fraction_ * rest;
    balance_.dashpots += (1.0 - drag_fraction_) * rest;
  }
  balance_.change = energy - start_;
  energy_ = energy;
  net_input_ = after.ledger.net_input;
}

}  // namespace hooke
