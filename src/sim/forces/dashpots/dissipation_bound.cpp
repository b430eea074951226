#include "sim/forces/dashpots/dissipation_bound.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "base/disjoint_sets.h"
#include "sim/forces/energy/energy.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/plan/spectrum_rows.h"

namespace hooke {
namespace {

bool has_damping(const System& system) {
  return system.drag_rate() > 0.0 ||
         std::ranges::any_of(system.springs(), [&](const Spring& spring) { return system.damping_of(spring) > 0.0; });
}

// Whether something but springs, gravity, drag and dashpots did work.
bool is_supplied(const Plan& plan, const Motion& motion) {
  using enum EnergyCause;
  if (plan.hand.held || plan.hand.pull || !plan.forces.empty() || !plan.spring.laws.empty() || !motion.breaks.empty()) return true;
  const auto acted = [&](EnergyCause cause) { return motion.energy[cause] != 0.0; };
  return std::ranges::any_of(std::array{Hand, Potentials, Forces, Colliders, Breaks, StrainLimit, Contact}, acted);
}

bool may_break(const System& system) {
  return std::ranges::any_of(system.springs(), [&](const Spring& spring) { return system.break_length_of(spring) != never_breaks; });
}

}  // namespace

double dashpot_power(const System& system, const State& state, const Spring& spring) {
  const double damping = system.damping_of(spring);
  if (damping == 0.0) return 0.0;
  const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
  const Vec3 along = state.position[j] - state.position[i];
  const double length = glm::length(along);
  if (length == 0.0) return 0.0;
  const double speed = glm::dot(state.velocity[j] - state.velocity[i], along) / length;
  return damping * speed * speed;
}

bool DissipationBound::is_divided(const System& system) {
  const SpringId last = system.spring_count() > 0 ? system.springs()[system.spring_count() - 1].id : SpringId{};
  if (points_ != system.point_count() || springs_ != system.spring_count() || last_ != last) {
    points_ = system.point_count();
    springs_ = system.spring_count();
    last_ = last;
    divide(system);
  }
  return !part_of_.empty();
}

void DissipationBound::divide(const System& system) {
  part_of_.clear();
  if (!has_damping(system)) return;
  const auto count = static_cast<std::size_t>(system.point_count());
  DisjointSets sets(count);
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    if (!system.points()[i].nailed && !system.points()[j].nailed) sets.join(i, j);
  }
  std::vector<Index> number(count, no_index);
  Index parts = 0;
  part_of_.resize(count, no_index);
  for (Index i = 0; i < system.point_count(); ++i) {
    if (system.points()[i].nailed) continue;
    Index& part = number[sets.root(i)];
    if (part == no_index) part = parts++;
    part_of_[i] = part;
  }
  if (parts <= 1) part_of_.clear();
  before_.assign(static_cast<std::size_t>(parts), {});
  after_ = before_;
}

void DissipationBound::measure(const System& system, const State& state, std::vector<Part>& parts) const {
  for (Part& part : parts) part.kinetic = part.energy = 0.0;
  for (Index i = 0; i < system.point_count(); ++i) {
    if (part_of_[i] == no_index) continue;
    const Point& point = system.points()[i];
    const double kinetic = 0.5 * point.mass * glm::dot(state.velocity[i], state.velocity[i]);
    parts[part_of_[i]].kinetic += kinetic;
    parts[part_of_[i]].energy += kinetic - point.mass * glm::dot(system.gravity, state.position[i]);
  }
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const Index part = part_of_[i] != no_index ? part_of_[i] : part_of_[j];
    if (part == no_index) continue;
    const double extension = glm::distance(state.position[i], state.position[j]) - spring.rest_length;
    parts[part].energy += 0.5 * system.stiffness_of(spring) * extension * extension;
  }
}

void DissipationBound::begin_frame(const System& system, const State& state) {
  start_ = state.time;
  kinetic_ = kinetic_energy(system, state);
  power_.clear();
  if (may_break(system))
    for (const Spring& spring : system.springs()) power_.push_back(dashpot_power(system, state, spring));
  if (is_divided(system)) measure(system, state, before_);
}

// [J], twice what the trapezoidal rule gives for the dashpots of springs that broke.
double DissipationBound::until_break(const std::vector<BrokenSpring>& breaks) const {
  double sum = 0.0;
  for (const BrokenSpring& broken : breaks)
    if (const auto s = static_cast<std::size_t>(broken.spring); s < power_.size())
      sum += (broken.time - start_) * (power_[s] + broken.dashpot_power);
  return sum;
}

double DissipationBound::end_frame(const Plan& plan, const System& system, const State& state, const Motion& motion) {
  const double duration = state.time - start_;
  if (!is_divided(system) || is_supplied(plan, motion))
    return max_dissipation(plan.spectrum, state.supply.scale, std::max(kinetic_, kinetic_energy(system, state)), duration) +
           until_break(motion.breaks);
  measure(system, state, after_);
  const SpectrumRows rows = spectrum_rows(system);
  for (Part& part : after_) part.rate = 0.0;
  for (std::size_t i = 0; i < part_of_.size(); ++i)
    if (const Index part = part_of_[i]; part != no_index) after_[part].rate = std::max(after_[part].rate, rows.dashpot[i]);
  double sum = 0.0;
  for (std::size_t k = 0; k < after_.size(); ++k) {
    const double loss = before_[k].energy - after_[k].energy;
    const Spectrum own{.dashpot_rate = after_[k].rate, .drag_rate = plan.spectrum.drag_rate};
    sum += std::clamp(loss, 0.0, max_dissipation(own, state.supply.scale, std::max(before_[k].kinetic, after_[k].kinetic), duration));
  }
  return sum;
}

}  // namespace hooke
