#include "sim/step/step.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/bands.h"
#include "sim/forces/forces.h"
#include "sim/forces/hand.h"
#include "sim/forces/spring_limits.h"
#include "sim/methods/implicit/supernodal_factor.h"
#include "sim/model/grab.h"

namespace hooke {

namespace {

// A method that linearizes the springs over a step stretches those that rotate, by up to the displacement of the hand: energy that comes
// from no force and that the next steps remove.
double stretch_energy(const System& system, double displacement) {
  double stiffness = 0.0;
  for (const Spring& spring : system.springs()) stiffness += system.stiffness_of(spring);
  return 0.5 * stiffness * displacement * displacement;
}

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

void Frame::begin(Plan& plan, const System& system, const Settings& settings, const State& state) {
  duration_ = 1.0 / settings.frame_rate;
  prepare_hand(plan, system, state, duration_);
  integrator_ = settings.integrator;
  substeps_ = settings.substeps;
  substeps_done_ = 0;
  failure_ = StepFailure::None;
  has_touched_ = has_impact_ = false;
  h_ = duration_ / substeps_;
  left_ = prepared_ = h_;
  locates_breaks_ = settings.locates_breaks && !plan.spring.break_length.empty();
  start_ = state.time;
  pack(plan, state, motion_);
  collider_displacement_ = plan.collider_paths.grabbed ? duration_ * plan.collider_paths.grabbed->velocity : Vec3(0.0);

  // a held point moves in a straight line to the target, as a point of infinite mass with that velocity: exact for every method
  const std::optional<ActiveGrab> grab = active_grab(system, state, duration_);
  const Vec3 from = grab && !system.grab ? state.position[system.index_of(grab->point)] : state.hand.position;
  target_ = grab ? clamp_hand_target(system, from, grab->target, duration_) : Vec3(0.0);
  const Vec3 displacement = !grab ? Vec3(0.0) : target_ - (plan.hand.held ? state.position[plan.listed_index(*plan.hand.held)] : from);
  hand_speed_ = (glm::length(displacement) + glm::length(collider_displacement_)) / duration_;
  hand_stretch_ = grab ? stretch_energy(system, glm::length(displacement) / substeps_) : 0.0;
  if (plan.hand.held) {
    const Vec3 velocity = displacement / duration_, before = state.velocity[plan.listed_index(*plan.hand.held)];
    for (int c = 0; c < plan.dimensions; ++c) motion_.v[static_cast<std::size_t>(c) * plan.points + *plan.hand.held] = velocity[c];
    motion_.hand_work = 0.5 * plan.hand.held_mass * (glm::dot(velocity, velocity) - glm::dot(before, before));
    motion_.abs_hand_work = std::abs(motion_.hand_work);
  }

  broken_.clear();
  broken_.reserve(plan.spring.break_length.size());
  motion_.breaks.reserve(plan.spring.break_length.size());
  work_.tolerance = settings.tolerance;
  work_.min_step = 1e-9 * h_;
  force_work_.begin_frame(plan, motion_);
  before_.damping.begin_frame(plan, integrator_->velocity_lag, motion_, work_);
  before_.begin_frame();
  sticking_.begin_frame(plan, motion_);
  before_.velocity_lag = integrator_->velocity_lag;
  before_.friction_lag = integrator_->symplectic ? integrator_->velocity_lag : 0.0;
  prepare_method(plan, h_);
  if (integrator_->advance != nullptr) adaptive_step_.begin_frame(plan, motion_, work_);
}

namespace {

// Whether nothing acts between two substeps or depends on the time.
bool acts_between_substeps(const Plan& plan) {
  return plan.hand.held || plan.hand.pull || plan.has_contact() || !plan.forces.empty() || !plan.spring.break_length.empty() ||
         !plan.spring.max_length.empty();
}

}  // namespace

// Several substeps at once, where the method is faster for it. Not after a part of a substep.
bool Frame::take_several(const Plan& plan) {
  constexpr int max_at_once = 64;
  const int count = std::min(max_at_once, substeps_ - substeps_done_);
  if (integrator_->steps == nullptr || count == 1 || left_ != h_ || prepared_ != h_ || acts_between_substeps(plan)) return false;
  force_work_.begin_substep(plan, motion_);
  integrator_->steps(plan, motion_, work_, h_, count);
  substeps_done_ += count;
  motion_.time = start_ + substeps_done_ * h_;
  motion_.measures_damping = false;
  force_work_.integrate_power(plan, motion_, count * h_);
  force_work_.end_substep(plan, motion_, count * h_, false);
  return true;
}

void Frame::substep(Plan& plan) {
  if (take_several(plan)) return;

  const bool is_adaptive = integrator_->advance != nullptr;
  const bool lags = integrator_->velocity_lag != 0.0 && !plan.spring.max_length.empty();
  if (left_ == h_) sticking_.begin_substep();
  sticking_.begin_step(plan, motion_);
  const bool may_release = !plan.force_data.sticky.held.empty();
  if (((plan.has_contact() || lags) && !is_adaptive) || may_release) keep_start(plan, motion_, before_);

  bool is_moved = false;
  const double length = may_release ? advance_to_release(plan, next_step(plan), is_moved) : advance(plan, next_step(plan), is_moved);
  if (length == 0.0) return;
  const bool ends = length == left_;
  left_ = ends ? h_ : left_ - length;
  substeps_done_ += ends ? 1 : 0;
  if (is_adaptive && substeps_done_ < substeps_ && adaptive_step_.is_at_limit(motion_)) failure_ = StepFailure::TooMany;
  if (!is_adaptive || ends || locates_breaks_) break_long_springs(plan);
  if (plan.touches_itself() && (is_adaptive ? adaptive_step_.has_too_many_pairs() : before_.has_too_many_pairs()))
    failure_ = StepFailure::TooManyPairs;
}

// By `length` [s], or by less with a method that adapts its step, up to where springs break. Returns the length; 0: it failed.
double Frame::advance(Plan& plan, double length, bool& is_moved) {
  const bool is_adaptive = integrator_->advance != nullptr, has_hand = plan.hand.held || plan.hand.pull;
  const double power = hand_power(plan, motion_), stored = energy_of_hand_alone(plan, motion_);
  if (is_adaptive) {
    length = adaptive_step_.advance(plan, *integrator_, motion_, work_, length, left_, force_work_);
  } else {
    if (length != prepared_) prepare_method(plan, length);
    prepared_ = length;
    if (failure_ != StepFailure::None) return 0.0;
    force_work_.begin_substep(plan, motion_);
    before_.damping.begin_substep(plan, motion_, work_);
    try {
      integrator_->step(plan, motion_, work_, length);
    } catch (const MatrixTooLarge&) {
      failure_ = StepFailure::MatrixTooLarge;
      return 0.0;
    }
    before_.damping.end_step(plan, motion_);
  }
  if (length == 0.0) {
    failure_ = adaptive_step_.is_at_limit(motion_) ? StepFailure::TooMany : StepFailure::TooShort;
    return 0.0;
  }
  motion_.time = length == left_ ? start_ + (substeps_done_ + 1) * h_ : motion_.time + length;

  // trapezoidal rule for the power of the hand, but for what it stores by itself
  if (has_hand) {
    const double work = 0.5 * length * (power + hand_power(plan, motion_)) + energy_of_hand_alone(plan, motion_) - stored;
    motion_.hand_work += work;
    motion_.abs_hand_work += std::abs(work);
  }
  // an adaptive step includes the strain limit, contact and the work of forces
  is_moved = false;
  if (!is_adaptive) {
    force_work_.integrate_power(plan, motion_, length);
    is_moved = act(plan, length);
    force_work_.end_substep(plan, motion_, length, is_moved);
  }
  return length;
}

// The same up to where a sticky plane lets go of the first point, if it does before.
double Frame::advance_to_release(Plan& plan, double length, bool& is_moved) {
  const StepCounters before(motion_, force_work_);
  while (true) {
    length = advance(plan, length, is_moved);
    if (length == 0.0) return 0.0;
    const double release = sticking_.time_of_release(plan, before_.x, before_.v, before_.time, length, motion_);
    if (release >= length) {
      sticking_.end_step(release == length);
      return length;
    }
    motion_.time = before_.time;
    motion_.x = before_.x;
    motion_.v = before_.v;
    motion_.acceleration_is_current = false;
    before.restore(motion_, force_work_);
    if (release > 0.0) {
      length = advance(plan, release, is_moved);
      sticking_.end_step(length == release);
      return length;
    }
    sticking_.release_at_start();
    sticking_.begin_step(plan, motion_);
  }
}

// What acts between two substeps: strain limit first, then contact; only after that do springs break. Returns whether points were moved.
bool Frame::act(Plan& plan, double h) {
  bool is_moved = limit_strain(plan, before_, motion_);
  if (plan.has_contact() && resolve_contacts(plan, before_, motion_, h)) {
    is_moved = has_touched_ = true;
    has_impact_ = has_impact_ || std::isfinite(before_.first_impact);
  }
  if (is_moved) motion_.acceleration_is_current = false;
  before_.damping.end_substep(plan, h, before_.is_limited, motion_);
  return is_moved;
}

void Frame::break_long_springs(Plan& plan) {
  if (plan.spring.break_length.empty() || !break_springs(plan, motion_, broken_)) return;
  motion_.acceleration_is_current = false;
  prepare_method(plan, prepared_);
}

void Frame::prepare_method(const Plan& plan, double h) {
  if (integrator_->prepare == nullptr) return;
  try {
    integrator_->prepare(plan, h, motion_, work_);
  } catch (const MatrixTooLarge&) {
    failure_ = StepFailure::MatrixTooLarge;
  }
}

// [s], to the end of the substep. Shorter where a spring is about to break and where a method that adapts its step would pass over
// oscillations of colliders, or of springs that break at their largest length: parts of the substep.
double Frame::next_step(const Plan& plan) const {
  const bool is_adaptive = integrator_->advance != nullptr;
  double max = is_adaptive ? plan.collider_paths.resolving_step : left_;
  if (locates_breaks_) {
    constexpr double max_angle = 0.25;       // [rad], of the fastest vibration
    constexpr double min_part = 1.0 / 64.0;  // of a substep, by which a spring may break too late
    if (is_adaptive && plan.spectrum.omega > 0.0) max = std::min(max, std::max(max_angle / plan.spectrum.omega, min_part * h_));
    const double step = std::max(time_to_break(plan, motion_), min_part * h_);
    if (step < max && left_ - step > min_part * h_) return step;
  }
  return left_ <= max ? left_ : left_ / std::ceil(left_ / max);
}

void Frame::end(const Plan& plan, State& state) const {
  unpack(plan, motion_, state);
  // a multiple of the frame duration stays one: rounding errors do not accumulate over a long run
  const double frames = (start_ + duration_) / duration_;
  state.time = std::abs(frames - std::round(frames)) < 1e-6 ? std::round(frames) * duration_ : start_ + duration_;
  state.hand.position = target_;
  if (auto& carried = state.hand.collider) carried->shape = translated(carried->shape, collider_displacement_);
  // energy that they dissipate was present before: counted as supplied, it would hide a divergence that feeds on it
  const double spent = motion_.force_work - motion_.reversible_work;
  for (const double work : {motion_.collider_work, motion_.break_work, motion_.limit_work, spent}) {
    state.ledger.net_input += work;
    state.ledger.scale += std::max(0.0, work);
  }
  state.ledger.add_reversible(motion_.reversible_work);
  state.ledger.net_input += motion_.hand_work;
  state.ledger.scale += motion_.abs_hand_work;
  state.ledger.hand_stretch = std::max(state.ledger.hand_stretch, hand_stretch_);
  if (state.ledger.extent && (plan.hand.held || plan.hand.pull || plan.collider_paths.grabbed)) {
    const double distance = state.hand.collider ? glm::length(anchor_of(state.hand.collider->shape)) : 0.0;
    state.ledger.extent = std::max({*state.ledger.extent, glm::length(target_), distance});
    state.ledger.speed = std::max(state.ledger.speed.value_or(0.0), hand_speed_);
  }
  if (plan.hand.held)
    for (int c = 0; c < plan.dimensions; ++c) state.position[plan.listed_index(*plan.hand.held)][c] = target_[c];
}

}  // namespace hooke
