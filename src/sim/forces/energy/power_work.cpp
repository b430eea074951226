#include "sim/forces/energy/power_work.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/constants.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/forces.h"
#include "sim/forces/spring_laws.h"
#include "sim/model/portable_math.h"

namespace hooke {
namespace {

double power_of_forces(const Plan& plan, double time, const Field& x, const Field& v) {
  double power = 0.0;
  for (const Force& force : plan.forces)
    if (force.term->power != nullptr) power += force.term->power(plan, force.values, time, x.data(), v.data());
  return power;
}

// [1/s], at which the power of this cause changes.
double rate_of(const Plan& plan, EnergyCause cause) {
  if (cause == EnergyCause::Drag) return plan.drag;
  if (cause == EnergyCause::Dashpots) return plan.spectrum.dashpot_rate;
  if (cause == EnergyCause::Muscles) return 0.0;
  return plan.spectrum.force_rate + plan.spectrum.estimated_rate;
}

// Whether three values of the power at the start, the middle and the end of a step are those of a smooth curve. Points faster than the air
// have higher rates than the spectrum says.
bool is_smooth(double start, double middle, double end) {
  return std::abs(start - 2.0 * middle + end) <= max_power_bend * std::max({std::abs(start), std::abs(middle), std::abs(end)});
}

// Positions of all points and their velocities.
struct Place {
  const Field &x, &v;
};

struct Separation {
  double length, speed;  // [m], [m/s]
};
Separation separation(const Plan& plan, const Place& place, Index first, Index second) {
  const Vec3 along = difference_at(plan, place.x, first, second);
  const double length = glm::length(along);
  return {length, length == 0.0 ? 0.0 : glm::dot(along, difference_at(plan, place.v, first, second)) / length};
}

// (a - b) / ln(a / b), of two powers that dissipate; 0 if one of them is.
double logarithmic_mean(double a, double b) {
  if (!(a * b > 0.0)) return 0.0;
  const double x = (b - a) / a;
  return std::abs(x) < 1e-4 ? a * (1.0 + 0.5 * x) : a * x / portable::log(b / a);
}

constexpr std::array by_power{EnergyCause::Forces, EnergyCause::Muscles, EnergyCause::Drag, EnergyCause::Dashpots};

}  // namespace

void PowerWork::begin_frame(const Plan& plan, const Motion& motion, double velocity_lag, DashpotSweeps& sweeps, bool measures_damping) {
  is_power_current_ = false;
  carried_ = 0.0;
  // where the velocity lags behind the positions, that of the path is the one after the step: a part of the impulses has acted before
  impulses_.part_after_contact = 1.0 - std::max(0.0, velocity_lag);
  impulses_.replace_power = false;
  has_forces_ = std::ranges::any_of(plan.forces, [](const Force& force) { return force.term->power != nullptr; });
  has_potential_ = std::ranges::any_of(plan.forces, [](const Force& force) { return force.term->potential != nullptr; });
  has_muscles_ = plan.spring.laws.move;
  has_air_ = plan.acceleration != plan.gravity;
  measures_drag_ = measures_damping && plan.drag > 0.0;
  measures_dashpots_ = measures_damping && plan.has_dashpots();
  sweeps_ = &sweeps;
  sweeps.measure(measures_dashpots_, motion.x.size());
  if (!has_power() && !has_potential_ && !has_air_) return;
  for (Field* field : {&x_, &v_, &middle_x_, &middle_v_}) field->resize(motion.x.size());
  if (!measures_dashpots_) return;
  free_x_.resize(motion.x.size());
  impulses_.length.resize(plan.spring.damping.size());
  impulses_.impulse.resize(plan.spring.damping.size());
}

EnergyLedger PowerWork::power(const Plan& plan, double time, const Field& x, const Field& v, std::optional<double> of_forces) const {
  EnergyLedger power;
  if (measures_drag_) power.add(EnergyCause::Drag, -2.0 * plan.drag * kinetic_energy(plan, v));
  if (measures_dashpots_ && !sweeps_->has_swept() && !impulses_.replace_power)
    power.add(EnergyCause::Dashpots, -dashpot_power(plan, time, x, v));
  if (has_muscles_) power.add(EnergyCause::Muscles, muscle_power(plan, time, x));
  power.add(EnergyCause::Forces, of_forces ? *of_forces : power_of_forces(plan, time, x, v));
  return power;
}

void PowerWork::begin_substep(const Plan& plan, const Motion& motion) {
  if (!has_power() && !has_potential_ && !has_air_) return;
  time_ = motion.time;
  work_ = {};
  std::ranges::copy(motion.x, x_.begin());
  if (!has_power()) return;
  std::ranges::copy(motion.v, v_.begin());
  if (!is_power_current_) power_ = power(plan, motion.time, motion.x, motion.v);
  if (measures_dashpots_) sweeps_->begin_step();
}

// By the power at the mean velocity and the mean position between the start of the substep and `end`.
EnergyLedger PowerWork::displacement_work(const Plan& plan, double h, const Field& end) {
  for (std::size_t i = 0; i < end.size(); ++i) {
    middle_x_[i] = 0.5 * (x_[i] + end[i]);
    middle_v_[i] = (end[i] - x_[i]) / h;
  }
  EnergyLedger work = power(plan, time_ + 0.5 * h, middle_x_, middle_v_);
  return work *= h;
}

void PowerWork::end_step(const Plan& plan, Motion& motion, double h) {
  if (!has_power()) return;
  const bool needs_path = has_muscles_ || measures_drag_ || measures_dashpots_;
  if (motion.power && !needs_path) return end_steps(plan, motion, h);
  const EnergyLedger start = power_;
  power_ = power(plan, motion.time, motion.x, motion.v, motion.power);
  is_power_current_ = true;
  if (measures_dashpots_) std::ranges::copy(motion.x, free_x_.begin());
  if (measures_dashpots_ && !sweeps_->has_swept() && plan.has_contact()) find_impulses(plan, motion);

  const auto is_resolved = [&](EnergyCause cause) { return rate_of(plan, cause) * h <= max_resolved_rate; };
  EnergyLedger middle;
  if (std::ranges::any_of(by_power, is_resolved)) {
    // of the cubic between both ends
    for (std::size_t i = 0; i < x_.size(); ++i) {
      middle_x_[i] = 0.5 * (x_[i] + motion.x[i]) + 0.125 * h * (v_[i] - motion.v[i]);
      middle_v_[i] = 1.5 / h * (motion.x[i] - x_[i]) - 0.25 * (v_[i] + motion.v[i]);
    }
    middle = power(plan, time_ + 0.5 * h, middle_x_, middle_v_);
  }
  const auto is_by_simpson = [&](EnergyCause cause) { return is_resolved(cause) && is_smooth(start[cause], middle[cause], power_[cause]); };
  work_ = std::ranges::all_of(by_power, is_by_simpson) ? EnergyLedger{} : displacement_work(plan, h, motion.x);
  EnergyLedger unresolved = work_;
  for (const EnergyCause cause : by_power) {
    if (!is_by_simpson(cause)) continue;
    work_[cause] = h / 6.0 * (start[cause] + 4.0 * middle[cause] + power_[cause]);
    unresolved[cause] = 0.0;
  }
  if (!plan.hand.held && !plan.hand.pull) limit_to_missing(plan, motion, unresolved);
}

// A step that does not resolve a damping force is braked by less than the power at its velocity says: by no more than the energy that is
// missing. Over the frame, because the energy of a method oscillates from substep to substep.
void PowerWork::limit_to_missing(const Plan& plan, const Motion& motion, const EnergyLedger& unresolved) {
  double taken = 0.0, supplied = has_air_ ? air_work(plan, x_, motion.x) : 0.0;
  // what muscles do is not part of the change below, at one time
  for (const EnergyCause cause : by_power)
    if (cause != EnergyCause::Muscles) (unresolved[cause] < 0.0 ? taken : supplied) += work_[cause];
  if (taken == 0.0) return;
  const double middle = 0.5 * (time_ + motion.time);
  const double change = kinetic_energy(plan, motion.v) - kinetic_energy(plan, v_) + potential_energy(plan, middle, motion.x) -
                        potential_energy(plan, middle, x_);
  const double possible = std::max(taken + carried_, std::min(0.0, change - supplied));
  carried_ += taken - possible;
  for (const EnergyCause cause : by_power)
    if (unresolved[cause] < 0.0 && cause != EnergyCause::Muscles) work_[cause] *= possible / taken;
}

void PowerWork::end_steps(const Plan& plan, Motion& motion, double h) {
  if (!has_power()) return;
  const EnergyLedger start = power_;
  power_ = power(plan, motion.time, motion.x, motion.v, motion.power);
  is_power_current_ = true;
  for (const EnergyCause cause : by_power) {
    const bool is_resolved = cause == EnergyCause::Forces || cause == EnergyCause::Muscles || rate_of(plan, cause) * h <= max_resolved_rate;
    const double mean = is_resolved ? 0.5 * (start[cause] + power_[cause]) : logarithmic_mean(start[cause], power_[cause]);
    work_[cause] = h * mean;
  }
  if (measures_dashpots_) std::ranges::copy(motion.x, free_x_.begin());
}

// The impulses d (l1 - l0) that dashpots exert in the method's step, and their work at the mean of the speeds before and after it.
void PowerWork::find_impulses(const Plan& plan, const Motion& motion) {
  impulses_.work = 0.0;
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const auto [l0, w0] = separation(plan, {x_, v_}, i, j);
    const auto [l1, w1] = separation(plan, {motion.x, motion.v}, i, j);
    impulses_.length[s] = l1;
    impulses_.impulse[s] = response_of(plan, s, motion.time, l1).damping * (l1 - l0);
    impulses_.work -= 0.5 * impulses_.impulse[s] * (w0 + w1);
  });
}

// [J], of the part of them that acts along the way on which contact then leads the points to `end`.
double PowerWork::impulse_work_after(const Plan& plan, double h, const Field& end) const {
  double work = 0.0;
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const double length = separation(plan, {end, end}, i, j).length;
    work -= impulses_.impulse[s] * (length - impulses_.length[s]) / h;
  });
  return impulses_.part_after_contact * work;
}

// Each sweep takes the kinetic energy that it measures. Where contact leads points elsewhere, its impulses act on what is as much faster.
double PowerWork::work_of_sweeps(const Plan& plan, double h, const Field& end) const {
  double work = 0.0;
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at)
      work += sweeps_->work()[at] + plan.mass[i] * sweeps_->change()[at] * (end[at] - free_x_[at]) / h;
  return work;
}

void PowerWork::end_point_contact(const Plan& plan, double h, Motion& motion) const {
  if (!measures_dashpots_ || !sweeps_->has_swept()) return;
  const auto n = static_cast<std::size_t>(plan.points);
  for (std::size_t i = 0; i < n; ++i) {
    bool has_moved = false;
    double work = 0.0;
    for (int c = 0; c < plan.dimensions; ++c) {
      const std::size_t at = static_cast<std::size_t>(c) * n + i;
      has_moved = has_moved || motion.x[at] != free_x_[at];
      work += plan.mass[i] * sweeps_->change()[at] * (free_x_[at] - x_[at]) / h - sweeps_->work()[at];
    }
    if (has_moved) motion.energy.add(EnergyCause::Contact, work);
  }
}

void PowerWork::end_substep(const Plan& plan, Motion& motion, double h, bool is_moved, bool is_limited) {
  if (!has_power() && !has_potential_ && !has_air_) return;
  if (has_power() && is_moved) {
    is_power_current_ = false;
    // What contact stops has not moved with the velocity at which the forces acted: at rest, that which the weight causes in a substep.
    // Where contact pushes points, as out of a collider, their displacement is the larger one, but no motion in which forces do work.
    const EnergyLedger moved = displacement_work(plan, h, motion.x);
    for (const EnergyCause cause : {EnergyCause::Forces, EnergyCause::Drag})
      if (std::abs(moved[cause]) < std::abs(work_[cause])) work_[cause] = moved[cause];
  }
  if (measures_dashpots_) {
    // the work of contact is that of its impulses, but the change of the energy where the strain limit has acted
    const bool acts_after = is_moved && !is_limited;
    if (sweeps_->has_swept())
      work_[EnergyCause::Dashpots] = work_of_sweeps(plan, h, acts_after ? motion.x : free_x_);
    else if (acts_after)
      work_[EnergyCause::Dashpots] = impulses_.work + impulse_work_after(plan, h, motion.x);
    else if (impulses_.replace_power)
      work_[EnergyCause::Dashpots] = impulses_.work;
    if (impulses_.replace_power != acts_after) is_power_current_ = false;
    impulses_.replace_power = acts_after && !sweeps_->has_swept();
  }
  if (has_air_) motion.energy.add(EnergyCause::Potentials, air_work(plan, x_, motion.x));
  if (has_potential_) add_potential_work(plan, motion, h);
  motion.energy += work_;
}

// A held point is moved by the hand, not by the forces: for the potentials, which may depend on all points together, it stays at the middle
// of its path.
void PowerWork::add_potential_work(const Plan& plan, Motion& motion, double h) {
  Field& end = middle_x_;
  std::ranges::copy(motion.x, end.begin());
  if (plan.hand.held)
    for (int c = 0; c < plan.dimensions; ++c) {
      const std::size_t held = static_cast<std::size_t>(c) * plan.points + static_cast<std::size_t>(*plan.hand.held);
      x_[held] = end[held] = 0.5 * (x_[held] + motion.x[held]);
    }
  for (const Force& force : plan.forces) {
    if (force.term->potential == nullptr) continue;
    const auto potential = [&](const Field& x) { return force.term->potential(plan, force.values, time_ + 0.5 * h, x.data()); };
    motion.energy.add(EnergyCause::Potentials, potential(x_) - potential(end));
  }
}

}  // namespace hooke
