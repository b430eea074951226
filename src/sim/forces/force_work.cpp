#include "sim/forces/force_work.h"

#include <algorithm>

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

}  // namespace

void ForceWork::begin_frame(const Plan& plan, const Motion& motion) {
  if (!has_work(plan)) return;
  x_.resize(motion.x.size());
  if (plan.forces.empty()) return;
  for (Field* field : {&x_, &v_, &middle_x_, &middle_v_}) field->resize(motion.x.size());
  power_ = power_of(plan, motion.time, motion.x, motion.v);
}

void ForceWork::begin_substep(const Plan& plan, const Motion& motion) {
  if (!has_work(plan)) return;
  time_ = motion.time;
  std::ranges::copy(motion.x, x_.begin());
  if (plan.forces.empty()) return;
  std::ranges::copy(motion.v, v_.begin());
}

double ForceWork::end_substep(const Plan& plan, const Motion& motion, double h) {
  if (!has_work(plan)) return 0.0;
  double work = air_work(plan, x_, motion.x);
  if (plan.forces.empty()) return work;
  const double middle = time_ + 0.5 * h;
  // A held point is moved by the hand, not by the forces: for the potentials, which may depend on all points together, it stays at the
  // middle of its path.
  Field& end_x = middle_x_;
  Vec3 held_start(0.0);
  std::ranges::copy(motion.x, end_x.begin());
  if (plan.held)
    for (int c = 0; c < plan.dimensions; ++c) {
      const std::size_t held = static_cast<std::size_t>(c) * plan.points + static_cast<std::size_t>(*plan.held);
      held_start[c] = x_[held];
      x_[held] = end_x[held] = 0.5 * (x_[held] + motion.x[held]);
    }
  bool has_power = false;
  for (const Force& force : plan.forces) {
    has_power = has_power || force.term->power != nullptr;
    if (force.term->potential == nullptr) continue;
    const auto potential = [&](const Field& x) { return force.term->potential(plan, force.values, middle, x.data()); };
    work += potential(x_) - potential(end_x);
  }
  if (!has_power) return work;
  if (plan.held)
    for (int c = 0; c < plan.dimensions; ++c)
      x_[static_cast<std::size_t>(c) * plan.points + static_cast<std::size_t>(*plan.held)] = held_start[c];

  const double start = power_;
  power_ = power_of(plan, time_ + h, motion.x, motion.v);
  // With a larger product Simpson's rule books more than implicit methods dissipate, by a share of (rate h)^2 / 12: a gain that there is
  // not.
  constexpr double max_resolved = 0.3;
  if (plan.spectrum.force_rate * h > max_resolved) {
    for (std::size_t i = 0; i < x_.size(); ++i) {
      middle_x_[i] = 0.5 * (x_[i] + motion.x[i]);
      middle_v_[i] = (motion.x[i] - x_[i]) / h;
    }
    return work + h * power_of(plan, middle, middle_x_, middle_v_);
  }
  for (std::size_t i = 0; i < x_.size(); ++i) {
    middle_x_[i] = 0.5 * (x_[i] + motion.x[i]) + 0.125 * h * (v_[i] - motion.v[i]);
    middle_v_[i] = 1.5 * (motion.x[i] - x_[i]) / h - 0.25 * (v_[i] + motion.v[i]);
  }
  return work + h / 6.0 * (start + 4.0 * power_of(plan, middle, middle_x_, middle_v_) + power_);
}

}  // namespace hooke
