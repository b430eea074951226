#include "sim/step/substep.h"

#include <algorithm>
#include <cmath>

#include "sim/forces/bands.h"
#include "sim/forces/hand.h"
#include "sim/forces/spring_limits.h"
#include "sim/methods/implicit/supernodal_factor.h"
#include "sim/step/constants.h"
#include "sim/step/frame_device.h"

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

// Whether anything acts between two substeps or depends on the time.
bool acts_between_substeps(const Plan& plan) {
  return plan.hand.held || plan.hand.pull || plan.has_contact() || !plan.forces.empty() || !plan.spring.laws.empty() ||
         !plan.spring.break_length.empty() || !plan.spring.max_length.empty();
}

}  // namespace

void Substep::begin_frame(Plan& plan, const Settings& settings, Motion& motion) {
  method_ = settings.integrator;
  start_ = motion.time;
  count_ = settings.substeps;
  h_ = 1.0 / settings.frame_rate / count_;
  left_ = prepared_ = h_;
  locates_breaks_ = settings.locates_breaks && !plan.spring.break_length.empty();
  has_touched_ = has_impact_ = false;
  failure_ = StepFailure::None;
  broken_.clear();
  broken_.reserve(plan.spring.break_length.size());

  work_.tolerance = settings.tolerance;
  work_.min_step = min_step_fraction * h_;
  work_.iterations = settings.iterations;
  // where springs have a largest length or touch each other, nothing but a measurement tells how much damping may have dissipated
  const bool measures_damping = settings.measures_damping || plan.touches_itself() || !plan.spring.max_length.empty();
  works_.begin_frame(plan, motion, method_->velocity_lag, work_.dashpots, measures_damping);
  before_.begin_frame();
  before_.works = &works_;
  before_.velocity_lag = method_->velocity_lag;
  before_.friction_lag = method_->is_symplectic() ? method_->velocity_lag : 0.0;
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
  if (done == 0 && plan.execution.device != nullptr &&
      plan.execution.device->advance(plan, {*method_, h_, count_, locates_breaks_}, motion, broken_))
    return count_;
  // what an edit stretched too far breaks at once: it may be shorter again after a substep
  if (done == 0 && left_ == h_) break_long_springs(plan, motion);
  if (const int taken = take_several(plan, motion, done); taken > 0) return taken;

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
  return ends ? 1 : 0;
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
  hand.add(plan, motion, length, work_.dashpots.has_swept());

  // strain limit and contact
  if (!is_adaptive()) {
    works_.end_step(plan, motion, length);
    is_moved = correct(plan, motion, length);
    works_.end_substep(plan, motion, length, is_moved, before_.is_limited);
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
    is_moved = has_touched_ = true;
    has_impact_ = has_impact_ || std::isfinite(before_.first_impact);
  }
  if (is_moved) motion.acceleration_is_current = false;
  return is_moved;
}

void Substep::break_long_springs(Plan& plan, Motion& motion) {
  if (plan.spring.break_length.empty() || !break_springs(plan, motion, broken_)) return;
  motion.acceleration_is_current = false;
  works_.forget_power();
  prepare_method(plan, prepared_, motion);
}

// [s], to the end of the substep. Shorter where a spring is about to break and where a method that adapts its step would pass over
// oscillations of colliders, or of springs that break at their largest length: parts of the substep.
double Substep::next_length(const Plan& plan, const Motion& motion) const {
  double max = is_adaptive() ? plan.resolving_step() : left_;
  if (locates_breaks_) {
    const double min_part = min_part_to_break * h_;
    if (is_adaptive() && plan.spectrum.omega > 0.0) max = std::min(max, std::max(max_angle_to_break / plan.spectrum.omega, min_part));
    const double step = std::max(time_to_break(plan, motion), min_part);
    if (step < max && left_ - step > min_part) return step;
  }
  return left_ <= max ? left_ : left_ / std::ceil(left_ / max);
}

// Several substeps at once, where the method is faster for it and nothing acts between two of them. Not after a part of a substep.
int Substep::take_several(const Plan& plan, Motion& motion, int done) {
  const int count = std::min(max_at_once, count_ - done);
  if (method_->steps == nullptr || count == 1 || left_ != h_ || prepared_ != h_ || acts_between_substeps(plan)) return 0;
  works_.begin_substep(plan, motion);
  method_->steps(plan, motion, work_, h_, count);
  motion.time = time_after(done + count);
  works_.end_steps(plan, motion, count * h_);
  works_.end_substep(plan, motion, count * h_, false);
  return count;
}

}  // namespace hooke
