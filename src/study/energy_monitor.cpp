#include "study/energy_monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "lab/lab_parts.h"
#include "sim/control/automatic.h"
#include "sim/forces/constants.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

double unexplained_energy(const System& system, const State& state) {
  return compute_energy(system, state).total() - state.supply.net_input;
}

// [J], in a frame, negative: by contact; and by drag and dashpots where contact or a strain limit may hide a gain. Elsewhere a gain is a
// rise of the energy, whereas damping acts on the velocities of the method, whose vibrations have another share of kinetic energy.
double measured_dissipation(const Plan& plan, const Motion& motion) {
  using enum EnergyCause;
  const EnergyLedger ledger = explained(motion.energy, plan.hand.held || plan.collider_paths.any_moves);
  const bool may_hide = plan.touches_itself() || !plan.spring.max_length.empty();
  return ledger[Contact] + (may_hide ? ledger[Drag] + ledger[Dashpots] : 0.0);
}

// [J], at most, in a frame by contact and forces. What colliders and forces do is part of the supplied energy, up to an error no larger
// than that; what contact with obstacles at rest dissipates is not.
double booked_dissipation(const Motion& motion) {
  using enum EnergyCause;
  return 2.0 * std::max(0.0, -motion.energy[Contact]) + std::abs(motion.energy[Colliders]) + std::abs(motion.energy[Forces]);
}

bool is_large(const State& state) { return state.position.size() >= min_points_of_large_run; }

bool has_modified_energy(const Settings& settings) { return settings.integrator->modified_energy != nullptr; }

// [J], at most, in a frame by forces whose damping the substeps do not resolve: less of it is recorded than a method dissipates.
double unresolved_dissipation(const Plan& plan, const Settings& settings, const State& state, double kinetic) {
  const int substeps = state.memory.choice ? state.memory.choice->substeps : settings.substeps;
  const double rate = plan.spectrum.force_rate + plan.spectrum.estimated_rate, duration = 1.0 / settings.frame_rate;
  if (!(rate * duration > max_resolved_rate * substeps)) return 0.0;
  return max_dissipation({.drag_rate = rate}, state.supply.scale, kinetic, duration);
}

// "6200 %": with two digits.
std::string percent_text(double fraction) {
  const double percent = 100.0 * fraction;
  if (!std::isfinite(percent) || percent < 100.0) return number_text(percent, 2) + " %";
  const double unit = std::pow(10.0, std::floor(std::log10(percent)) - 1.0);
  return number_text(unit * std::round(percent / unit), 2) + " %";
}

}  // namespace

// A state, and the motion that ended in it if there is one.
struct EnergyMonitor::Now {
  const Plan& plan;
  const Settings& settings;
  const State& state;
  const Motion* motion;
};

EnergyMonitor::EnergyMonitor(const Plan& plan, const Settings& settings, const System& system, const State& start)
    : start_{unexplained_energy(system, start), start.position.size()},
      dashpot_rate_(plan.spectrum.dashpot_rate),
      scale_(start.supply.scale) {
  // the method may become one whose modified energy is known
  if (is_large(start) && !is_automatic(settings))
    keep(start_, {plan, settings, start, nullptr});
  else
    start_.state = std::make_shared<const State>(start);
  lowest_ = start_;
}

// [J], by how much the modified energy exceeds that of the scene.
double EnergyMonitor::modified_difference(const Now& now) {
  const auto modified_energy = now.settings.integrator->modified_energy;
  const double h = now.settings.substep();
  // a large motion is not packed again; it is of another Plan if springs broke, and does not have the place of a held point
  if (is_large(now.state) && now.motion != nullptr && now.motion->counts.breaks == 0 && !now.plan.hand.held)
    return modified_energy(now.plan, *now.motion, h);
  Motion motion;
  pack(now.plan, now.state, motion);
  return modified_energy(now.plan, motion, h);
}

// Makes it possible to compute later by how much the modified energy changed since.
void EnergyMonitor::keep(Reference& reference, const Now& now) {
  reference.points = now.state.position.size();
  reference.difference.reset();
  reference.state = nullptr;  // before the next one takes memory
  if (!has_modified_energy(now.settings)) return;
  if (is_large(now.state))
    reference.difference = modified_difference(now);
  else
    reference.state = std::make_shared<const State>(now.state);
}

// [J], of the energy that the method conserves best.
double EnergyMonitor::modified_change(Reference& since, double energy, const Now& now) {
  const double change = energy - since.energy;
  const auto points = static_cast<std::size_t>(now.plan.points);
  if (!has_modified_energy(now.settings) || now.state.position.size() != points || since.points != points) return change;
  if (!since.difference) {
    if (since.state == nullptr) return change;
    since.difference = modified_difference({now.plan, now.settings, *since.state, nullptr});
  }
  const double modified = change + modified_difference(now) - *since.difference;
  if (change * modified <= 0.0) return 0.0;
  return std::abs(modified) < std::abs(change) ? modified : change;
}

void EnergyMonitor::end_frame(const Plan& plan, const Settings& settings, const System& system, const State& state, const Motion& motion) {
  const Now now{plan, settings, state, &motion};
  const double energy = unexplained_energy(system, state);
  scale_ = state.supply.scale;
  dissipated_ += measured_dissipation(plan, motion);
  const double kinetic = kinetic_energy(system, state);
  Spectrum damping = plan.spectrum;
  damping.dashpot_rate = std::max(damping.dashpot_rate, std::exchange(dashpot_rate_, damping.dashpot_rate));
  max_dissipated_ += max_dissipation(damping, scale_, std::max(kinetic_, kinetic), 1.0 / settings.frame_rate) + booked_dissipation(motion) +
                     unresolved_dissipation(plan, settings, state, kinetic);
  if (energy - lowest_.energy > rise_.energy) {
    const double rise = modified_change(lowest_, energy, now);
    if (rise > rise_.energy) rise_ = {rise, state.time};
  }
  if (energy < lowest_.energy) {
    lowest_.energy = energy;
    keep(lowest_, now);
  }
  // What contact, drag and dashpots dissipate hides a gain: the energy falls all the same. Those of a gain that is reported anyway, and of
  // one that is too small for that, are not needed.
  constexpr double min_part = 0.01;  // of the supplied energy
  gain_ = energy - start_.energy - dissipated_;
  if (gain_ > std::max(min_part * scale_, hidden_gain_.energy)) {
    const double gain = modified_change(start_, energy - dissipated_, now);
    if (gain > hidden_gain_.energy) hidden_gain_ = {gain, state.time};
  }
  // a rise is reported above, and what the scene may dissipate is no error
  const bool is_loss = start_.energy - energy > min_part * scale_ + max_dissipated_;
  change_ = is_loss ? modified_change(start_, energy, now) : energy - start_.energy;
  if (const double loss = -change_ - max_dissipated_; is_loss && loss > loss_.energy) loss_ = {loss, state.time};
}

// `present`: what is left of it [J]. Where that is little, the balance at the end does not show it.
std::string EnergyMonitor::describe(const Extreme& extreme, double present, const char* kind) const {
  const std::string until = present < 0.25 * extreme.energy ? " until " + quantity_text(extreme.time, "s", 4) : "";
  return "energy balance off by " + percent_text(extreme.energy / scale_) + " of the energy supplied (" + kind + until + ")";
}

std::string EnergyMonitor::warning(double tolerance) const {
  // a run that loses most of its energy may gain some in between
  const double limit = tolerance * scale_;
  const Extreme& gain = hidden_gain_.energy > rise_.energy ? hidden_gain_ : rise_;
  if (gain.energy > limit && gain.energy >= loss_.energy) return describe(gain, gain_, "gain");
  if (loss_.energy > limit) return describe(loss_, -change_ - max_dissipated_, "loss");
  return {};
}

}  // namespace hooke
