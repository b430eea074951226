#include "sim/step/step.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "sim/contact/clearance.h"
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
  substeps_done_ = one_by_one_until_ = 0;
  failure_ = StepFailure::None;
  has_touched_ = has_impact_ = false;
  h_ = duration_ / substeps_;
  left_ = prepared_ = h_;
  locates_breaks_ = settings.locates_breaks && !plan.break_length.empty();
  start_ = state.time;
  pack(plan, state, motion_);
  collider_displacement_ = plan.grabbed_collider ? duration_ * plan.grabbed_collider->velocity : Vec3(0.0);

  // a held point moves in a straight line to the target, as a point of infinite mass with that velocity: exact for every method
  const std::optional<ActiveGrab> grab = active_grab(system, state, duration_);
  const Vec3 from = grab && !system.grab ? state.position[system.index_of(grab->point)] : state.hand.position;
  target_ = grab ? clamp_hand_target(system, from, grab->target, duration_) : Vec3(0.0);
  const Vec3 displacement = !grab ? Vec3(0.0) : target_ - (plan.held ? state.position[plan.listed_index(*plan.held)] : from);
  hand_speed_ = (glm::length(displacement) + glm::length(collider_displacement_)) / duration_;
  hand_stretch_ = grab ? stretch_energy(system, glm::length(displacement) / substeps_) : 0.0;
  if (plan.held) {
    const Vec3 velocity = displacement / duration_, before = state.velocity[plan.listed_index(*plan.held)];
    for (int c = 0; c < plan.dimensions; ++c) motion_.v[static_cast<std::size_t>(c) * plan.points + *plan.held] = velocity[c];
    motion_.hand_work = 0.5 * plan.held_mass * (glm::dot(velocity, velocity) - glm::dot(before, before));
    motion_.abs_hand_work = std::abs(motion_.hand_work);
  }

  broken_.clear();
  broken_.reserve(plan.break_length.size());
  motion_.breaks.reserve(plan.break_length.size());
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

// Several substeps at once, so many that they take about a millisecond, or more if there are more springs. Whether anything acts
// between them is known only afterwards: then they are taken back.
bool Frame::fly(Plan& plan) {
  constexpr int springs_at_once = 1'000'000, max_at_once = 64;
  const int at_once =
      plan.execution.single ? max_at_once : std::clamp(springs_at_once / std::max(1, static_cast<int>(plan.springs)), 8, max_at_once);
  const int count = std::min(at_once, substeps_ - substeps_done_);
  const bool is_worth_it = integrator_->fly != nullptr && !plan.touches_itself() && plan.springs >= min_springs_of_grids && count > 1;
  // not after a part of a substep
  if (left_ != h_ || prepared_ != h_) return false;
  if (!is_worth_it || substeps_done_ < one_by_one_until_ || !can_fly(plan)) return false;
  one_by_one_until_ = substeps_done_ + count;
  motion_.moved = {};

  Flight flight{.clearance = compute_clearance(plan, motion_.x)};
  if (flight.was_interrupted()) return false;
  const bool may_be_interrupted = !plan.colliders.empty() || !plan.break_length.empty() || !plan.max_length.empty();
  if (may_be_interrupted) keep_start(plan, motion_, before_);
  force_work_.begin_substep(plan, motion_);
  integrator_->fly(plan, motion_, work_, h_, count, flight);
  if (flight.was_interrupted()) {
    motion_.time = before_.time;
    motion_.x = before_.x;
    motion_.v = before_.v;
    motion_.acceleration_is_current = false;
    return false;
  }
  substeps_done_ += count;
  motion_.time = start_ + substeps_done_ * h_;
  motion_.measures_damping = false;
  return true;
}

// Whether the substep that contact ended left every bit as it was before: then so do all that follow it.
bool Frame::is_at_rest(const Plan& plan) const {
  const bool acts_alone = plan.max_length.empty() && plan.break_length.empty() && plan.forces.empty() && !plan.touches_itself();
  if (integrator_->fly == nullptr || !acts_alone || !can_fly(plan)) return false;
  const auto is_same = [](const Field& a, const Field& b) { return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0; };
  return is_same(motion_.v, before_.v) && is_same(motion_.x, before_.x);
}

// The rest of the frame at rest, with what each substep counts: force evaluations, sweeps over dashpots, and the work of contact.
void Frame::stay(long evaluations, long sweeps) {
  for (; substeps_done_ < substeps_; ++substeps_done_) {
    motion_.force_evaluations += evaluations;
    motion_.dashpot_sweeps += sweeps;
    motion_.contact_work += before_.contact_work;
  }
  motion_.time = start_ + substeps_done_ * h_;
}

void Frame::substep(Plan& plan) {
  const int done_before = substeps_done_;
  if (fly(plan)) {
    const double flown = (substeps_done_ - done_before) * h_;
    force_work_.integrate_power(plan, motion_, flown);
    const bool is_moved = act(plan, h_, false);
    force_work_.end_substep(plan, motion_, flown, is_moved);
    break_long_springs(plan);
    return;
  }

  const bool is_adaptive = integrator_->advance != nullptr;
  const bool lags = integrator_->velocity_lag != 0.0 && !plan.max_length.empty();
  if (left_ == h_) sticking_.begin_substep();
  sticking_.begin_step(plan, motion_);
  const bool may_release = !plan.sticky.held.empty();
  if (((plan.has_contact() || lags) && !is_adaptive) || may_release) keep_start(plan, motion_, before_);

  const long evaluations_before = motion_.force_evaluations, sweeps_before = motion_.dashpot_sweeps;
  const bool knew_acceleration = motion_.acceleration_is_current;
  bool is_moved = false;
  const double length = may_release ? advance_to_release(plan, next_step(plan), is_moved) : advance(plan, next_step(plan), is_moved);
  if (length == 0.0) return;
  const bool ends = length == left_;
  left_ = ends ? h_ : left_ - length;
  substeps_done_ += ends ? 1 : 0;
  if (is_adaptive && substeps_done_ < substeps_ && adaptive_step_.is_at_limit(motion_)) failure_ = StepFailure::TooMany;
  if (!is_adaptive || ends || locates_breaks_) break_long_springs(plan);
  const long sweeps = motion_.dashpot_sweeps - sweeps_before;
  // dashpots among the forces act at velocities that the state does not contain
  const bool is_state_complete = !plan.has_dashpots() || sweeps > 0;
  if (is_moved && !knew_acceleration && is_state_complete && is_at_rest(plan)) stay(motion_.force_evaluations - evaluations_before, sweeps);
  if (plan.touches_itself() && (is_adaptive ? adaptive_step_.has_too_many_pairs() : before_.has_too_many_pairs()))
    failure_ = StepFailure::TooManyPairs;
}

// By `length` [s], or by less with a method that adapts its step, up to where springs break. Returns the length; 0: it failed.
double Frame::advance(Plan& plan, double length, bool& is_moved) {
  const bool is_adaptive = integrator_->advance != nullptr, has_hand = plan.held || plan.pull;
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
    is_moved = act(plan, length, true);
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
    motion_.moved = {};
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
bool Frame::act(Plan& plan, double h, bool may_touch) {
  bool is_moved = limit_strain(plan, before_, motion_);
  if (may_touch && plan.has_contact() && resolve_contacts(plan, before_, motion_, h)) {
    if (!is_moved && motion_.acceleration_is_current && !plan.touches_itself()) motion_.moved = before_.touched;
    is_moved = has_touched_ = true;
    has_impact_ = has_impact_ || std::isfinite(before_.first_impact);
  }
  if (is_moved) motion_.acceleration_is_current = false;
  if (may_touch) before_.damping.end_substep(plan, h, before_.is_limited, motion_);
  return is_moved;
}

void Frame::break_long_springs(Plan& plan) {
  if (plan.break_length.empty() || !break_springs(plan, motion_, broken_)) return;
  motion_.acceleration_is_current = false;
  motion_.moved = {};
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
  double max = is_adaptive ? plan.resolving_step : left_;
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
  if (state.ledger.extent && (plan.held || plan.pull || plan.grabbed_collider)) {
    const double distance = state.hand.collider ? glm::length(anchor_of(state.hand.collider->shape)) : 0.0;
    state.ledger.extent = std::max({*state.ledger.extent, glm::length(target_), distance});
    state.ledger.speed = std::max(state.ledger.speed.value_or(0.0), hand_speed_);
  }
  if (plan.held)
    for (int c = 0; c < plan.dimensions; ++c) state.position[plan.listed_index(*plan.held)][c] = target_[c];
}

}  // namespace hooke
