#include "sim/forces/dashpots/dashpot_sweeps.h"

#include <algorithm>

#include "sim/forces/spring_laws.h"

namespace hooke {

void DashpotSweeps::prepare(const Plan& plan, double duration) {
  duration_ = duration;
  plan_dashpot_decay(plan, duration, decay_);
}

void DashpotSweeps::measure(bool is_measured, std::size_t size) {
  is_measured_ = is_measured;
  has_swept_ = false;
  if (!is_measured) return;
  for (Field* field : {&before_, &change_, &work_}) field->resize(size);
}

void DashpotSweeps::begin_step() {
  if (!is_measured_) return;
  has_swept_ = false;
  std::ranges::fill(change_, 0.0);
  std::ranges::fill(work_, 0.0);
}

void DashpotSweeps::sweep(const Plan& plan, SweepDirection sweep, double time, const Field& x, Field& v) {
  if (!is_measured_) return apply(plan, sweep, time, x, v);
  std::ranges::copy(v, before_.begin());
  apply(plan, sweep, time, x, v);
  has_swept_ = true;
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at) {
      const double change = v[at] - before_[at];
      change_[at] += change;
      work_[at] += plan.mass[i] * change * (before_[at] + 0.5 * change);
    }
}

void DashpotSweeps::apply(const Plan& plan, SweepDirection sweep, double time, const Field& x, Field& v) {
  if (sweep == SweepDirection::Backward) sweep_law_dashpots(plan, sweep, duration_, time, x, v);
  decay_dashpots(plan, decay_, sweep, x, v);
  if (sweep == SweepDirection::Forward) sweep_law_dashpots(plan, sweep, duration_, time, x, v);
}

}  // namespace hooke
