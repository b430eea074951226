#include "study/run_monitor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/energy.h"
#include "sim/forces/force_term.h"
#include "sim/frame_error.h"

namespace hooke {
namespace {

double unexplained_energy(const System& system, const State& state) {
  return compute_energy(system, state).total() - state.ledger.net_input;
}

// Whether the scene itself dissipates energy: then a loss is not known to be an error of the method.
bool loses_energy(const System& system) {
  const auto may_dissipate = [](const Force& force) { return force.on && force.term->power != nullptr; };
  return std::ranges::any_of(system.forces, may_dissipate) || system.drag_rate() > 0.0 || !system.colliders.empty() ||
         std::ranges::any_of(system.springs(), [&](const Spring& spring) { return system.damping_of(spring) > 0.0; });
}

std::string clause(const char* pattern, double value) {
  char text[120];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

}  // namespace

RunMonitor::RunMonitor(const System& system, const State& start, int frames_per_estimate)
    : frames_per_estimate_(frames_per_estimate),
      start_energy_(unexplained_energy(system, start)),
      energy_(start_energy_),
      lowest_energy_(start_energy_),
      scale_(start.ledger.scale) {}

void RunMonitor::begin_frame(const System& system, const Settings& settings, const State& state) {
  if (estimate_is_due()) estimated_error_ += frames_per_estimate_ * estimate_frame_error(system, settings, state);
}

void RunMonitor::end_frame(const System& system, const State& state, const Motion& motion) {
  ++frames_;
  unconverged_solves_ += motion.unconverged_solves;
  energy_ = unexplained_energy(system, state);
  scale_ = state.ledger.scale;
  largest_rise_ = std::max(largest_rise_, energy_ - lowest_energy_);
  lowest_energy_ = std::min(lowest_energy_, energy_);
}

std::vector<std::string> RunMonitor::warnings(const System& system, const Tolerance& tolerance) const {
  std::vector<std::string> warnings;
  if (unconverged_solves_ > 0)
    warnings.push_back(std::to_string(unconverged_solves_) + (unconverged_solves_ == 1 ? " solve" : " solves") + " did not converge");
  if (energy_rise() > tolerance.energy)
    warnings.push_back(clause("energy balance off by %.2g %% of the energy supplied (gain)", 100.0 * energy_rise()));
  else if (!loses_energy(system) && energy_change() < -tolerance.energy)
    warnings.push_back(clause("energy balance off by %.2g %% of the energy supplied (loss)", -100.0 * energy_change()));
  if (!(estimated_error_ <= tolerance.position)) warnings.push_back(clause("estimated error: %.1g m in total", estimated_error_));
  return warnings;
}

}  // namespace hooke
