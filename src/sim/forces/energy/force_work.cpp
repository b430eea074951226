#include "sim/forces/energy/force_work.h"

#include <algorithm>
#include <cmath>

#include "sim/forces/constants.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"

namespace hooke {
namespace {

double power_of(const Plan& plan, double time, const Field& x, const Field& v) {
  double sum = 0.0;
  for (const Force& force : plan.forces)
    if (force.term->power != nullptr) sum += force.term->power(plan, force.values, time, x.data(), v.data());
  return sum;
}

// The acceleration of every point by moving air, through drag, which is constant.
Vec3 air_acceleration(const Plan& plan) { return plan.acceleration - plan.gravity; }
bool has_work(const Plan& plan) { return !plan.forces.empty() || air_acceleration(plan) != Vec3(0.0); }

// [J], on the way from `start` to `end`: exact for any path.
double air_work(const Plan& plan, const Field& start, const Field& end) {
  const Vec3 acceleration = air_acceleration(plan);
  double work = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    if (acceleration[c] == 0.0) continue;
    const std::size_t begin = static_cast<std::size_t>(c) * plan.points;
    double moment = 0.0;
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] != 0.0) moment += plan.mass[i] * (end[begin + i] - start[begin + i]);
    work += acceleration[c] * moment;
  }
  return work;
}

// [J], what the potentials of the forces supply on the way from `start` to `end`.
double potential_work(const Plan& plan, double time, const Field& start, const Field& end) {
  double work = 0.0;
  for (const Force& force : plan.forces) {
    if (force.term->potential == nullptr) continue;
    const auto potential = [&](const Field& x) { return force.term->potential(plan, force.values, time, x.data()); };
    work += potential(start) - potential(end);
  }
  return work;
}

// [J], by the power at the mean velocity and the mean position between two positions of all points, which is left in `x` and `v`.
double displacement_work(const Plan& plan, double start_time, double h, const Field& start, const Field& end, Field& x, Field& v) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = 0.5 * (start[i] + end[i]);
    v[i] = (end[i] - start[i]) / h;
  }
  return h * power_of(plan, start_time + 0.5 * h, x, v);
}

}  // namespace

void ForceWork::begin_frame(const Plan& plan, const Motion& motion) {
  memory_ = {};
  has_power_ = std::ranges::any_of(plan.forces, [](const Force& force) { return force.term->power != nullptr; });
  has_potential_ = std::ranges::any_of(plan.forces, [](const Force& force) { return force.term->potential != nullptr; });
  is_alone_ = !plan.hand.held && !plan.hand.pull && air_acceleration(plan) == Vec3(0.0);
  if (!has_work(plan)) return;
  x_.resize(motion.x.size());
  if (plan.forces.empty()) return;
  for (Field* field : {&v_, &middle_x_, &middle_v_}) field->resize(motion.x.size());
}

void ForceWork::begin_substep(const Plan& plan, const Motion& motion) {
  if (!has_work(plan)) return;
  time_ = motion.time;
  power_work_ = 0.0;
  // a method that knows the power at the end of its steps needs no more
  if (!motion.power || plan.has_contact() || has_potential_ || air_acceleration(plan) != Vec3(0.0)) std::ranges::copy(motion.x, x_.begin());
  if (!has_power_) return;
  if (!motion.power) std::ranges::copy(motion.v, v_.begin());
  if (!memory_.power_is_current) memory_.power = power_of(plan, motion.time, motion.x, motion.v);
}

// [J], of motion, springs, gravity and the potentials of forces since the start of the substep.
double ForceWork::energy_change(const Plan& plan, const Motion& motion) const {
  double kinetic = 0.0;
  for (std::size_t at = 0; at < v_.size(); ++at)
    if (const std::size_t i = at % static_cast<std::size_t>(plan.points); plan.inverse_mass[i] != 0.0)
      kinetic += 0.5 * plan.mass[i] * (motion.v[at] * motion.v[at] - v_[at] * v_[at]);
  return kinetic + stored_energy(plan, motion.x) - stored_energy(plan, x_) -
         potential_work(plan, 0.5 * (time_ + motion.time), x_, motion.x);
}

void ForceWork::integrate_power(const Plan& plan, Motion& motion, double h) {
  if (!has_power_) return;
  const double start = memory_.power, middle = time_ + 0.5 * h;
  memory_.power_is_current = true;
  if (motion.power) {
    memory_.power = *motion.power;
    power_work_ = 0.5 * h * (start + memory_.power);
    return;
  }
  memory_.power = power_of(plan, motion.time, motion.x, motion.v);
  if ((plan.spectrum.force_rate + plan.spectrum.estimated_rate) * h <= max_resolved_rate) {
    set_cubic_middle({x_.data(), v_.data(), motion.x.data(), motion.v.data()}, h, middle_x_.data(), middle_v_.data(), x_.size());
    const double in_the_middle = power_of(plan, middle, middle_x_, middle_v_);
    if (std::abs(start - 2.0 * in_the_middle + memory_.power) <=
        max_power_bend * std::max({std::abs(start), std::abs(in_the_middle), std::abs(memory_.power)})) {
      power_work_ = h / 6.0 * (start + 4.0 * in_the_middle + memory_.power);
      return;
    }
  }
  power_work_ = displacement_work(plan, time_, h, x_, motion.x, middle_x_, middle_v_);
  // No more than is missing, where nothing else supplies energy: a linearly implicit step brakes fast points less than their velocity says.
  // Within a frame, because the energy of a method oscillates from substep to substep.
  if (is_alone_ && power_work_ < 0.0) {
    power_work_ += memory_.carried;
    const double possible = std::max(power_work_, std::min(0.0, energy_change(plan, motion)));
    memory_.carried = power_work_ - possible;
    power_work_ = possible;
  }
}

void ForceWork::end_substep(const Plan& plan, Motion& motion, double h, bool is_moved) {
  if (!has_work(plan)) return;
  if (is_moved) memory_.power_is_current = false;
  // What contact stops has not moved with the velocity at which the forces acted: at rest, that which the weight causes in a substep. Where
  // contact pushes points, as out of a collider, their displacement is the larger one, but no motion in which forces do work.
  if (is_moved && has_power_ && plan.has_contact()) {
    const double work = displacement_work(plan, time_, h, x_, motion.x, middle_x_, middle_v_);
    if (std::abs(work) < std::abs(power_work_)) {
      power_work_ = work;
      memory_.carried = 0.0;
    }
  }
  double reversible = air_work(plan, x_, motion.x);
  if (has_potential_) {
    const double middle = time_ + 0.5 * h;
    // A held point is moved by the hand, not by the forces: for the potentials, which may depend on all points together, it stays at the
    // middle of its path.
    Field& end_x = middle_x_;
    std::ranges::copy(motion.x, end_x.begin());
    if (plan.hand.held)
      for (int c = 0; c < plan.dimensions; ++c) {
        const std::size_t held = static_cast<std::size_t>(c) * plan.points + static_cast<std::size_t>(*plan.hand.held);
        x_[held] = end_x[held] = 0.5 * (x_[held] + motion.x[held]);
      }
    reversible += potential_work(plan, middle, x_, end_x);
  }
  motion.force_work += reversible + power_work_;
  motion.reversible_work += reversible;
}

}  // namespace hooke
