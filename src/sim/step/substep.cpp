#include "sim/step/substep.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sim/contact/clearance.h"
#include "sim/forces/bands.h"
#include "sim/forces/hand.h"
#include "sim/forces/spring_limits.h"
#include "sim/methods/implicit/supernodal_factor.h"
#include "sim/step/constants.h"

namespace hooke {
namespace {

// Keeps where the substep starts.
void keep_start(const Plan& plan, const Motion& motion, ContactWorkspace& before) {
  constexpr Index min_numbers = 16'000;  // some microseconds
  before.time = motion.time;
  before.x.resize(motion.x.size());
  before.v.resize(motion.v.size());
  for_parts(plan, static_cast<Index>(motion.x.size()), min_numbers, [&](int, Index first, Index end) {
    std::copy(motion.x.begin() + first, motion.x.begin() + end, before.x.begin() + first);
    std::copy(motion.v.begin() + first, motion.v.begin() + end, before.v.begin() + first);
  });
}

}  // namespace

void Substep::begin_frame(Plan& plan, const Settings& settings, Motion& motion) {
  method_ = settings.integrator;
  start_ = motion.time;
  count_ = settings.substeps;
  h_ = 1.0 / settings.frame_rate / count_;
  left_ = prepared_ = h_;
  one_by_one_ = 0;
  locates_breaks_ = settings.locates_breaks && !plan.spring.break_length.empty();
  has_touched_ = has_impact_ = false;
  failure_ = StepFailure::None;
  broken_.clear();
  broken_.reserve(plan.spring.break_length.size());
  motion.breaks.reserve(plan.spring.break_length.size());

  work_.tolerance = settings.tolerance;
  work_.min_step = min_step_fraction * h_;
  // where springs have a largest length or touch each other, nothing but a measurement tells how much damping may have dissipated
  const bool measures_damping = settings.measures_damping || plan.touches_itself() || !plan.spring.max_length.empty();
  works_.begin_frame(plan, motion, work_.dashpots, measures_damping);
  before_.begin_frame();
  before_.velocity_lag = method_->velocity_lag;
  before_.friction_lag = method_->symplectic ? method_->velocity_lag : 0.0;
  before_.kicks_last = method_->kicks_last;
  sticking_.begin_frame(plan, motion);
  prepare_method(plan, h_, motion);
  if (is_adaptive()) adaptive_.begin_frame(plan, motion);
}

void Substep::prepare_method(const Plan& plan, double h, const Motion& motion) {
  prepared_ = h;
  if (method_->prepare == nullptr) return;
  try {
    method_->prepare(plan, h, motion, work_);
  } catch (const MatrixTooLarge&) {
    failure_ = StepFailure::MatrixTooLarge;
  }
}

int Substep::advance(Plan& plan, Motion& motion, int done) {
  if (const int flown = fly(plan, motion, done); flown > 0) return flown;

  const EnergyLedger ledger = motion.energy;
  const long evaluations = motion.counts.force_evaluations, sweeps = motion.counts.dashpot_sweeps;
  const bool knew_acceleration = motion.acceleration_is_current;
  bool is_moved = false;
  const double length = step(plan, motion, done, is_moved);
  if (length == 0.0) return 0;
  const bool ends = length == left_;
  left_ = ends ? h_ : left_ - length;
  if (ends) ++done;

  // springs break where steps of a given length end, or where their breaks are located
  if (!is_adaptive() || ends || locates_breaks_) break_long_springs(plan, motion);
  if (is_adaptive() && done < count_ && adaptive_.is_at_limit(motion)) failure_ = StepFailure::TooMany;
  if (plan.touches_itself() && (is_adaptive() ? adaptive_.has_too_many_pairs() : before_.has_too_many_pairs()))
    failure_ = StepFailure::TooManyPairs;
  if (!ends) return 0;

  // where contact has left every bit as it was, the rest of the frame is as this substep: dashpots among the forces would act at velocities
  // that the state does not contain
  const bool is_state_complete = !plan.has_dashpots() || motion.counts.dashpot_sweeps > sweeps;
  if (!is_moved || knew_acceleration || !is_state_complete || !is_at_rest(plan, motion)) return 1;
  EnergyLedger of_substep = motion.energy;
  of_substep -= ledger;
  const long more_evaluations = motion.counts.force_evaluations - evaluations, more_sweeps = motion.counts.dashpot_sweeps - sweeps;
  const int rest = count_ - done;
  motion.energy += of_substep *= rest;
  motion.counts.force_evaluations += rest * more_evaluations;
  motion.counts.dashpot_sweeps += rest * more_sweeps;
  motion.time = time_after(count_);
  return 1 + rest;
}

// A step of at most the time that is left of the substep, with all that belongs to it but the breaks. Returns its length [s]; 0: it failed.
double Substep::step(Plan& plan, Motion& motion, int done, bool& is_moved) {
  sticking_.begin_step(plan, motion);
  const bool lags = method_->velocity_lag != 0.0 && !plan.spring.max_length.empty();
  if ((plan.has_contact() || lags) && !is_adaptive()) keep_start(plan, motion, before_);
  const HandWork hand(plan, motion);

  // the method; an adaptive step includes the strain limit, contact and its own bookkeeping
  double length = next_length(plan, motion);
  if (is_adaptive()) {
    length = adaptive_.advance(plan, *method_, motion, work_, length, left_, works_);
    if (length == 0.0) failure_ = adaptive_.is_at_limit(motion) ? StepFailure::TooMany : StepFailure::TooShort;
  } else if (!step_by_method(plan, motion, length)) {
    length = 0.0;
  }
  if (length == 0.0) return 0.0;
  motion.time = length == left_ ? time_after(done + 1) : motion.time + length;

  // the hand
  hand.add(plan, motion, length);

  // strain limit and contact
  if (!is_adaptive()) {
    works_.end_step(plan, motion, length);
    is_moved = correct(plan, motion, length);
    works_.end_substep(plan, motion, length, is_moved);
  }
  sticking_.end_step(plan, length, motion);
  return length;
}

bool Substep::step_by_method(const Plan& plan, Motion& motion, double length) {
  if (length != prepared_) prepare_method(plan, length, motion);
  if (failure_ != StepFailure::None) return false;
  works_.begin_substep(plan, motion);
  try {
    method_->step(plan, motion, work_, length);
  } catch (const MatrixTooLarge&) {
    failure_ = StepFailure::MatrixTooLarge;
    return false;
  }
  return true;
}

// Strain limit first, then contact. Returns whether points were moved.
bool Substep::correct(const Plan& plan, Motion& motion, double h) {
  bool is_moved = limit_strain(plan, before_, motion);
  if (plan.has_contact() && resolve_contacts(plan, before_, motion, h)) {
    if (!is_moved && motion.acceleration_is_current && !plan.touches_itself()) motion.moved = before_.touched;
    is_moved = has_touched_ = true;
    has_impact_ = has_impact_ || std::isfinite(before_.first_impact);
  }
  if (is_moved) motion.acceleration_is_current = false;
  return is_moved;
}

void Substep::break_long_springs(Plan& plan, Motion& motion) {
  if (plan.spring.break_length.empty() || !break_springs(plan, motion, broken_)) return;
  motion.acceleration_is_current = false;
  motion.moved = {};
  works_.forget_power();
  prepare_method(plan, prepared_, motion);
}

// [s], to the end of the substep. Shorter where a spring is about to break and where a method that adapts its step would pass over
// oscillations of colliders, or of springs that break at their largest length: parts of the substep.
double Substep::next_length(const Plan& plan, const Motion& motion) const {
  double max = is_adaptive() ? plan.collider_paths.resolving_step : left_;
  if (locates_breaks_) {
    const double min_part = min_part_to_break * h_;
    if (is_adaptive() && plan.spectrum.omega > 0.0) max = std::min(max, std::max(max_angle_to_break / plan.spectrum.omega, min_part));
    const double step = std::max(time_to_break(plan, motion), min_part);
    if (step < max && left_ - step > min_part) return step;
  }
  return left_ <= max ? left_ : left_ / std::ceil(left_ / max);
}

// Several substeps at once. Whether anything acts between them is known only afterwards: then they are taken back, and as many are made one
// by one. Returns how many; 0: none.
int Substep::fly(Plan& plan, Motion& motion, int done) {
  // not after a part of a substep
  if (left_ != h_ || prepared_ != h_) return 0;
  if (one_by_one_ > 0) {
    --one_by_one_;
    return 0;
  }
  const int at_once = plan.execution.single
                          ? max_at_once
                          : std::clamp(springs_at_once / std::max(1, static_cast<int>(plan.springs)), min_at_once, max_at_once);
  const int count = std::min(at_once, count_ - done);
  const bool is_worth_it = method_->fly != nullptr && !plan.touches_itself() && plan.springs >= min_springs_of_grids && count > 1;
  if (!is_worth_it || !can_fly(plan)) return 0;
  motion.moved = {};
  one_by_one_ = count - 1;

  Flight flight{.clearance = compute_clearance(plan, motion.x)};
  if (flight.was_interrupted()) return 0;
  const bool may_be_interrupted = !plan.colliders.empty() || !plan.spring.break_length.empty() || !plan.spring.max_length.empty();
  if (may_be_interrupted) keep_start(plan, motion, before_);
  works_.begin_substep(plan, motion);
  method_->fly(plan, motion, work_, h_, count, flight);
  if (flight.was_interrupted()) {
    motion.time = before_.time;
    motion.x = before_.x;
    motion.v = before_.v;
    motion.acceleration_is_current = false;
    return 0;
  }
  one_by_one_ = 0;
  motion.time = time_after(done + count);
  works_.end_steps(plan, motion, count * h_);
  const bool is_moved = limit_strain(plan, before_, motion);
  if (is_moved) motion.acceleration_is_current = false;
  works_.end_substep(plan, motion, count * h_, is_moved);
  break_long_springs(plan, motion);
  return count;
}

// Whether the substep that contact ended left every bit as it was before: then so do all that follow it.
bool Substep::is_at_rest(const Plan& plan, const Motion& motion) const {
  const bool acts_alone =
      plan.spring.max_length.empty() && plan.spring.break_length.empty() && plan.forces.empty() && !plan.touches_itself();
  if (method_->fly == nullptr || !acts_alone || !can_fly(plan)) return false;
  const auto is_same = [](const Field& a, const Field& b) { return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0; };
  return is_same(motion.v, before_.v) && is_same(motion.x, before_.x);
}

}  // namespace hooke
