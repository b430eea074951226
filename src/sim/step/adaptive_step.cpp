#include "sim/step/adaptive_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/model/portable_math.h"

namespace hooke {
namespace {

void store(const Motion& motion, ContactWorkspace& state) {
  state.time = motion.time;
  std::ranges::copy(motion.x, state.x.begin());
  std::ranges::copy(motion.v, state.v.begin());
  state.impulse = motion.contact;
}

// Without contact and a strain limit a step needs no correction.
bool has_corrections(const Plan& plan) { return plan.has_contact() || !plan.spring.max_length.empty(); }

}  // namespace

void AdaptiveStep::begin_frame(const Plan& plan, const Motion& motion) {
  free_step_ = 0.0;
  surface_steps_ = 0;
  if (!has_corrections(plan)) return;
  for (Field* field : {&before_.x, &before_.v, &piece_.x, &piece_.v, &coarse_x_, &coarse_v_}) field->resize(motion.x.size());
  for (ContactWorkspace* each : {&before_, &piece_}) each->begin_frame();
}

// For another attempt with the step `next` [s]. A memory without an error stands for a first step, whose length the method chooses itself:
// each attempt would be that step again.
void AdaptiveStep::take_back(const Step& step, const ContactWorkspace& start, const Taken& before, double next) {
  Motion& motion = step.motion;
  motion.time = start.time;
  std::ranges::copy(start.x, motion.x.begin());
  std::ranges::copy(start.v, motion.v.begin());
  motion.contact = start.impulse;
  motion.acceleration_is_current = false;
  const double error = before.memory.error > 0.0 ? before.memory.error : motion.memory.error;
  motion.memory = {.step = next, .error = error};
  motion.energy = before.energy;
  motion.local_error = before.local_error;
  step.works.forget_power();
}

// A step of the method alone.
double AdaptiveStep::advance_freely(const Step& step, double interval) {
  Motion& motion = step.motion;
  step.works.begin_substep(step.plan, motion);
  const double start = motion.time, h = step.method.advance(step.plan, motion, step.work, interval);
  if (h == 0.0) return 0.0;
  motion.time = start + h;
  step.works.end_step(step.plan, motion, h);
  motion.time = start;
  return h;
}

// Strain limit first, then contact. Returns whether anything touched.
bool AdaptiveStep::correct(const Step& step, ContactWorkspace& before, double h, bool ends) {
  const Plan& plan = step.plan;
  Motion& motion = step.motion;
  before.is_limited = false;
  const bool is_limited = ends && limit_strain(plan, before, motion);
  if (plan.surface.on) ++surface_steps_;
  const bool touches = plan.has_contact() && resolve_contacts(plan, before, motion, h);
  if (is_limited || touches) motion.acceleration_is_current = false;
  step.works.end_substep(plan, motion, h, is_limited || touches, is_limited);
  return touches;
}

// RMS over the free points of the distance between two fields. Overwrites `coarse`.
double AdaptiveStep::difference(const Plan& plan, Field& coarse, const Field& fine) const {
  for (std::size_t i = 0; i < fine.size(); ++i) coarse[i] -= fine[i];
  return root_mean_square(plan, coarse);
}

// The same step in pieces, such that no impact is followed by more than about half of the time that followed it in the whole step. Returns
// h, or 0 where no step is short enough.
double AdaptiveStep::advance_in_pieces(const Step& step, double h, bool ends) {
  Motion& motion = step.motion;
  const double start = motion.time;
  // the method knows nothing of what follows an impact, such as the force of a spring that it compresses: where nothing but a constant
  // force acted before, halves of the step that split it before the impact would both leave out the same
  double split = 0.5 * (std::min(before_.first_touch, h) + h);
  int splits = 1;
  first_touch_ = std::numeric_limits<double>::infinity();
  for (double done = 0.0; done < h;) {
    if (is_at_limit(motion)) return 0.0;
    store(motion, piece_);
    const Taken before = taken(motion);
    const double end = done < split ? split : h, left = end - done, length = advance_freely(step, left);
    if (length == 0.0) return 0.0;
    const double next = length == left ? end : done + length;
    const bool touches = correct(step, piece_, length, ends && next == h);
    if (touches && std::isinf(first_touch_)) first_touch_ = done + piece_.first_touch;
    const double impact = done + piece_.first_impact;
    if (touches && next - impact > max_piece * (h - impact) && splits < max_splits) {
      split = 0.5 * (impact + h);
      ++splits;
      take_back(step, piece_, before, split - done);
      continue;
    }
    ends_free_ = !touches;
    done = next;
    motion.time = start + done;
  }
  motion.time = start;
  return h;
}

double AdaptiveStep::advance(const Plan& plan, const Integrator& method, Motion& motion, Workspace& work, double interval, double left,
                             PowerWork& works) {
  const Step step{plan, method, motion, work, works};
  // the strain limit is imposed once per substep and does not converge with the step, so that no step would be short enough for it; contact
  // of faces and springs is of first order, with impacts that never end while a cloth folds
  if (has_corrections(plan) && work.tolerance && plan.spring.max_length.empty() && !plan.surface.on)
    return advance_within_tolerance(step, interval, left);

  if (has_corrections(plan)) store(motion, before_);
  const double h = advance_freely(step, interval);
  if (h == 0.0) return 0.0;
  if (has_corrections(plan))
    correct(step, before_, h, h == left);
  else
    works.end_substep(plan, motion, h, false);
  return h;
}

double AdaptiveStep::advance_within_tolerance(const Step& step, double interval, double left) {
  Motion& motion = step.motion;
  ErrorScale scale(step.plan, motion, *step.work.tolerance);
  scale.position = std::max(scale.position, contact_round_off);
  scale.velocity = std::max(scale.velocity, contact_velocity_round_off);
  store(motion, before_);
  while (true) {
    const Taken before = taken(motion);
    const double h = advance_freely(step, interval);
    if (h == 0.0) return 0.0;
    const bool ends = h == left;
    if (!correct(step, before_, h, ends)) return h;

    // the same step in pieces
    std::ranges::copy(motion.x, coarse_x_.begin());
    std::ranges::copy(motion.v, coarse_v_.begin());
    const double free_step = motion.memory.step;
    take_back(step, before_, before, 0.5 * h);
    if (advance_in_pieces(step, h, ends) == 0.0) return 0.0;

    // a third of the difference is the error of the finer result
    const double position = difference(step.plan, coarse_x_, motion.x) / 3.0, velocity = difference(step.plan, coarse_v_, motion.v) / 3.0;
    const double error = scale.relative(position, velocity);
    if (!std::isfinite(error)) return 0.0;
    const double factor =
        error == 0.0 ? max_contact_step_factor
                     : std::clamp(contact_step_safety * portable::pow(error, -1.0 / 3.0), min_contact_step_factor, max_contact_step_factor);
    if (error <= 1.0 || h <= step.work.min_step) {
      motion.local_error += position;
      accept(step, before, h, factor, free_step);
      return h;
    }
    const double contact_step = std::max(step.work.min_step, factor * h);
    if (const double length = end_before_impact(step, before, h, contact_step); length >= 0.0) return length;
    take_back(step, before_, before, contact_step);
  }
}

// Sets the next step after one of h with contact. A step truncated by the end of the interval says little about it.
void AdaptiveStep::accept(const Step& step, const Taken& before, double h, double factor, double free_step) {
  const double contact_step = factor == max_contact_step_factor ? std::max(before.memory.step, max_contact_step_factor * h) : factor * h;
  double& next = step.motion.memory.step;
  next = std::max(step.work.min_step, std::min(free_step, contact_step));
  if (ends_free_) next = std::max(next, free_step_);
  free_step_ = 0.0;
}

// An impact, for which the step of h is too long: a step that ends before it, by a part of the length that the contact requires. Returns
// its length; 0: no step is short enough; negative: there is none, because the first contact is not an impact or too near.
double AdaptiveStep::end_before_impact(const Step& step, const Taken& before, double h, double contact_step) {
  double impact = first_touch_;
  for (int attempt = 0; attempt < max_attempts_before_impact && std::isfinite(impact) && impact > 2.0 * contact_step; ++attempt) {
    take_back(step, before_, before, h);
    const double jump = impact - gap_before_impact * contact_step, length = advance_freely(step, jump);
    if (length == 0.0) return 0.0;
    if (!correct(step, before_, length, false)) {
      free_step_ = std::max(free_step_, h);
      if (length == jump) step.motion.memory.step = contact_step;
      return length;
    }
    impact = before_.first_touch;
  }
  return -1.0;
}

}  // namespace hooke
