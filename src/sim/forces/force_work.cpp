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

}  // namespace

void ForceWork::begin_frame(const Plan& plan, const Motion& motion) {
  if (plan.forces.empty()) return;
  for (Field* field : {&x_, &v_, &middle_x_, &middle_v_}) field->resize(motion.x.size());
  power_ = power_of(plan, motion.time, motion.x, motion.v);
}

void ForceWork::begin_substep(const Plan& plan, const Motion& motion) {
  if (plan.forces.empty()) return;
  time_ = motion.time;
  std::ranges::copy(motion.x, x_.begin());
  std::ranges::copy(motion.v, v_.begin());
}

double ForceWork::end_substep(const Plan& plan, const Motion& motion, double h) {
  if (plan.forces.empty()) return 0.0;
  const double middle = time_ + 0.5 * h;
  double work = 0.0;
  bool has_power = false;
  for (const Force& force : plan.forces) {
    has_power = has_power || force.term->power != nullptr;
    if (force.term->potential == nullptr) continue;
    const auto potential = [&](const Field& x) { return force.term->potential(plan, force.values, middle, x.data()); };
    work += potential(x_) - potential(motion.x);
  }
  if (!has_power) return work;

  for (std::size_t i = 0; i < x_.size(); ++i) {
    middle_x_[i] = 0.5 * (x_[i] + motion.x[i]) + 0.125 * h * (v_[i] - motion.v[i]);
    middle_v_[i] = 1.5 * (motion.x[i] - x_[i]) / h - 0.25 * (v_[i] + motion.v[i]);
  }
  const double start = power_;
  power_ = power_of(plan, time_ + h, motion.x, motion.v);
  // a rate that the substep does not resolve dissipates all the energy of its motion, once
  const double resolved = 1.0 / std::max(1.0, plan.spectrum.force_rate * h);
  return work + resolved * h / 6.0 * (start + 4.0 * power_of(plan, middle, middle_x_, middle_v_) + power_);
}

}  // namespace hooke
