#include "sim/contact/damping_work.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/contact_work.h"

namespace hooke {
namespace {

bool is_measured(const Plan& plan) {
  return (plan.has_dashpots() || plan.drag > 0.0) && (plan.touches_itself() || !plan.spring.max_length.empty());
}

double spring_length(const Plan& plan, const Field& x, Index first, Index second) {
  double sum = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    const double* at = x.data() + static_cast<std::size_t>(c) * plan.points;
    sum += (at[second] - at[first]) * (at[second] - at[first]);
  }
  return std::sqrt(sum);
}

// [m/s], at which the ends of a spring of this length separate.
double speed_along(const Plan& plan, const Field& x, const Field& v, Index first, Index second, double length) {
  if (length == 0.0) return 0.0;
  double sum = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t at = static_cast<std::size_t>(c) * plan.points;
    sum += (x[at + second] - x[at + first]) * (v[at + second] - v[at + first]);
  }
  return sum / length;
}

}  // namespace

void DampingWork::begin_frame(const Plan& plan, double velocity_lag, Motion& motion, Workspace& work) {
  velocity_lag_ = velocity_lag;
  is_measured_ = motion.measures_damping = is_measured(plan);
  work.dashpots.measure(is_measured_ && plan.has_dashpots(), motion.x.size());
  if (!is_measured_) return;
  for (Field* field : {&x_, &v_, &free_x_, &free_v_}) field->resize(motion.x.size());
}

void DampingWork::begin_substep(const Plan& plan, const Motion& motion, Workspace& work) {
  limit_work_ = motion.limit_work;
  if (!is_measured_) return;
  start_ = motion.time;
  std::ranges::copy(motion.x, x_.begin());
  std::ranges::copy(motion.v, v_.begin());
  contact_work_ = motion.contact_work;
  dashpot_work_ = motion.dashpot_work;
  sweeps_ = &work.dashpots;
  if (plan.has_dashpots()) work.dashpots.begin_step();
}

void DampingWork::end_step(const Plan&, const Motion& motion) {
  if (!is_measured_) return;
  std::ranges::copy(motion.x, free_x_.begin());
  std::ranges::copy(motion.v, free_v_.begin());
}

// Sweeps act at the velocities between which they lead, not all over the step: contact has not done what they did more than that.
void DampingWork::end_point_contact(const Plan& plan, double h, Motion& motion) {
  if (!is_measured_ || !plan.has_dashpots() || !sweeps_->has_swept()) return;
  const auto n = static_cast<std::size_t>(plan.points);
  for (std::size_t i = 0; i < n; ++i) {
    bool has_touched = false;
    double work = 0.0;
    for (int c = 0; c < plan.dimensions; ++c) {
      const std::size_t at = static_cast<std::size_t>(c) * n + i;
      has_touched = has_touched || motion.x[at] != free_x_[at] || motion.v[at] != free_v_[at];
      work += plan.mass[i] * sweeps_->change()[at] * (free_x_[at] - x_[at]) / h - sweeps_->work()[at];
    }
    if (has_touched) motion.contact_work += work;
  }
}

// Each sweep dissipates the kinetic energy that it takes. Where contact moves points to `end`, its impulses act on what is as
// much faster.
double DampingWork::work_of_sweeps(const Plan& plan, double h, const Motion* end) const {
  const Field& x = end != nullptr ? end->x : free_x_;
  double work = 0.0;
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at)
      work += sweeps_->work()[at] + plan.mass[i] * sweeps_->change()[at] * (x[at] - free_x_[at]) / h;
  return work;
}

// A dashpot exerts the impulse -d (l1 - l0) in the step, l its length, on ends that separate with the mean of the velocities before and
// after it. Contact that then moves them to `end` acts at the start of the path: they are as much faster. Where the velocity lags behind
// the positions, that of the path is the one after the step: half of the impulse has acted before contact, so that it does no work on what
// contact leaves at rest.
double DampingWork::work_of_forces(const Plan& plan, double h, const Motion* end) const {
  double free = 0.0, moved = 0.0;
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) {
      const Index first = run.first + e, second = run.second + e;
      const double d = plan.spring.damping[run.begin + e];
      if (d == 0.0) continue;
      const double l0 = spring_length(plan, x_, first, second), l1 = spring_length(plan, free_x_, first, second);
      const double w0 = speed_along(plan, x_, v_, first, second, l0), w1 = speed_along(plan, free_x_, free_v_, first, second, l1);
      free -= 0.5 * d * (l1 - l0) * (w0 + w1);
      if (end != nullptr) moved -= d * (l1 - l0) * (spring_length(plan, end->x, first, second) - l1) / h;
    }
  moved *= 1.0 - std::max(0.0, velocity_lag_);
  // Where steps do not resolve the dashpots, that is more than they can exert: no more than is missing, where nothing else supplies
  // energy.
  constexpr double max_resolved = 0.3;
  if (plan.spectrum.dashpot_rate * h > max_resolved && !plan.hand.held && !plan.hand.pull) {
    const double before = kinetic_energy(plan, v_) + potential_energy(plan, start_ + 0.5 * h, x_);
    const double after = kinetic_energy(plan, free_v_) + potential_energy(plan, start_ + 0.5 * h, free_x_);
    if (const double possible = std::min(0.0, after - before); free < possible) {
      moved *= possible / free;
      free = possible;
    }
  }
  return std::min(0.0, free) + moved;
}

void DampingWork::end_substep(const Plan& plan, double h, bool is_limited, Motion& motion) {
  double limit = motion.limit_work - limit_work_;
  if (is_measured_ && plan.drag > 0.0) motion.drag_work -= h * plan.drag * (kinetic_energy(plan, v_) + kinetic_energy(plan, motion.v));
  if (is_measured_ && plan.has_dashpots()) {
    // the work of contact is the change of the energy where the strain limit has acted, and otherwise that of its impulses
    const Motion* end = is_limited ? nullptr : &motion;
    motion.dashpot_work += sweeps_->has_swept() ? work_of_sweeps(plan, h, end) : work_of_forces(plan, h, end);
    double dashpots = motion.dashpot_work - dashpot_work_, contact = motion.contact_work - contact_work_;
    for (double* other : {&limit, &contact}) {
      const double canceled = canceled_work(*other, dashpots);
      *other -= canceled;
      dashpots += canceled;
    }
    motion.dashpot_work = dashpot_work_ + dashpots;
    motion.limit_work = limit_work_ + limit;
    motion.contact_work = contact_work_ + contact;
  }
  // a strain limit only stops what separates: what it has supplied on its own is an error
  if (limit > 0.0 && !plan.hand.held && !plan.collider_paths.any_moves) motion.limit_gain += limit;
}

}  // namespace hooke
