#include "sim/step/adaptive_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/model/portable_math.h"

namespace hooke {

StepCounters::StepCounters(const Motion& motion, const ForceWork& work)
    : memory(motion.memory),
      collider_work(motion.collider_work),
      contact_work(motion.contact_work),
      hand_work(motion.hand_work),
      abs_hand_work(motion.abs_hand_work),
      limit_work(motion.limit_work),
      limit_gain(motion.limit_gain),
      force_work(motion.force_work),
      reversible_work(motion.reversible_work),
      drag_work(motion.drag_work),
      dashpot_work(motion.dashpot_work),
      local_error(motion.local_error),
      forces(work.memory()) {}

void StepCounters::restore(Motion& motion, ForceWork& work) const {
  motion.memory = memory;
  motion.collider_work = collider_work;
  motion.contact_work = contact_work;
  motion.hand_work = hand_work;
  motion.abs_hand_work = abs_hand_work;
  motion.limit_work = limit_work;
  motion.limit_gain = limit_gain;
  motion.force_work = force_work;
  motion.reversible_work = reversible_work;
  motion.drag_work = drag_work;
  motion.dashpot_work = dashpot_work;
  motion.local_error = local_error;
  work.restore(forces);
}

namespace {

// For another attempt with this step [s]. A memory without an error stands for a first step, whose length the method chooses itself: each
// attempt would be that step again.
void restore(const StepCounters& before, double step, Motion& motion, ForceWork& work) {
  const MethodMemory memory{.step = step, .error = before.memory.error > 0.0 ? before.memory.error : motion.memory.error};
  before.restore(motion, work);
  motion.memory = memory;
}

void store(const Motion& motion, ContactWorkspace& state) {
  state.time = motion.time;
  std::ranges::copy(motion.x, state.x.begin());
  std::ranges::copy(motion.v, state.v.begin());
}

void restore(const ContactWorkspace& state, Motion& motion) {
  motion.time = state.time;
  std::ranges::copy(state.x, motion.x.begin());
  std::ranges::copy(state.v, motion.v.begin());
  motion.acceleration_is_current = false;
}

// Without contact and a strain limit a step needs no correction.
bool has_corrections(const Plan& plan) { return plan.has_contact() || !plan.spring.max_length.empty(); }

// A step of the method alone, with the work of forces and damping along it.
double advance_freely(const Plan& plan, const Integrator& method, Motion& motion, Workspace& work, double interval, DampingWork& damping,
                      ForceWork& force_work) {
  force_work.begin_substep(plan, motion);
  damping.begin_substep(plan, motion, work);
  const double start = motion.time, h = method.advance(plan, motion, work, interval);
  if (h == 0.0) return 0.0;
  motion.time = start + h;
  force_work.integrate_power(plan, motion, h);
  motion.time = start;
  damping.end_step(plan, motion);
  return h;
}

}  // namespace

void AdaptiveStep::begin_frame(const Plan& plan, Motion& motion, Workspace& work) {
  free_step_ = 0.0;
  surface_steps_ = 0;
  for (ContactWorkspace* each : {&before_, &piece_}) each->damping.begin_frame(plan, 0.0, motion, work);
  if (!has_corrections(plan)) return;
  for (Field* field : {&before_.x, &before_.v, &piece_.x, &piece_.v, &coarse_x_, &coarse_v_}) field->resize(motion.x.size());
  for (ContactWorkspace* each : {&before_, &piece_}) each->begin_frame();
}

// Strain limit first, then contact. Returns whether anything touched.
bool AdaptiveStep::correct(const Plan& plan, ContactWorkspace& before, Motion& motion, double h, bool ends, ForceWork& force_work) {
  before.is_limited = false;
  const bool is_limited = ends && limit_strain(plan, before, motion);
  if (plan.surface.on) ++surface_steps_;
  const bool touches = plan.has_contact() && resolve_contacts(plan, before, motion, h);
  const bool is_moved = is_limited || touches;
  if (is_moved) motion.acceleration_is_current = false;
  before.damping.end_substep(plan, h, is_limited, motion);
  force_work.end_substep(plan, motion, h, is_moved);
  return touches;
}

// RMS over the free points of the distance between two fields. Overwrites `coarse`.
double AdaptiveStep::difference(const Plan& plan, Field& coarse, const Field& fine) const {
  for (std::size_t i = 0; i < fine.size(); ++i) coarse[i] -= fine[i];
  return root_mean_square(plan, coarse);
}

// The same step in pieces, such that no impact is followed by more than about half of the time that followed it in the whole step. Returns
// h, or 0 where no step is short enough.
double AdaptiveStep::advance_in_pieces(const Plan& plan, const Integrator& method, Motion& motion, Workspace& work, double h, bool ends,
                                       ForceWork& force_work) {
  const double start = motion.time;
  // the method knows nothing of what follows an impact, such as the force of a spring that it compresses: where nothing but a constant
  // force acted before, halves of the step that split it before the impact would both leave out the same
  constexpr double max_part = 0.55;
  constexpr int max_splits = 8;
  double split = 0.5 * (std::min(before_.first_touch, h) + h);
  int splits = 1;
  first_touch_ = std::numeric_limits<double>::infinity();
  for (double done = 0.0; done < h;) {
    if (is_at_limit(motion)) return 0.0;
    store(motion, piece_);
    const StepCounters before(motion, force_work);
    const double end = done < split ? split : h, left = end - done,
                 length = advance_freely(plan, method, motion, work, left, piece_.damping, force_work);
    if (length == 0.0) return 0.0;
    const bool reaches_end = length == left;
    const double next = reaches_end ? end : done + length;
    const bool touches = correct(plan, piece_, motion, length, ends && next == h, force_work);
    if (touches && std::isinf(first_touch_)) first_touch_ = done + piece_.first_touch;
    const double impact = done + piece_.first_impact;
    if (touches && next - impact > max_part * (h - impact) && splits < max_splits) {
      split = 0.5 * (impact + h);
      ++splits;
      restore(piece_, motion);
      restore(before, split - done, motion, force_work);
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
                             ForceWork& force_work) {
  if (!has_corrections(plan)) {
    const double h = advance_freely(plan, method, motion, work, interval, before_.damping, force_work);
    if (h != 0.0) force_work.end_substep(plan, motion, h, false);
    return h;
  }

  // the strain limit is imposed once per substep and does not converge with the step, so that no step would be short enough for it; contact
  // of faces and springs is of first order, with impacts that never end while a cloth folds
  if (!work.tolerance || !plan.spring.max_length.empty() || plan.surface.on) {
    store(motion, before_);
    const double h = advance_freely(plan, method, motion, work, interval, before_.damping, force_work);
    if (h != 0.0) correct(plan, before_, motion, h, h == left, force_work);
    return h;
  }

  // contact is resolved to about 1e-13 of the coordinates, and the velocity after an impact to that over its duration
  ErrorScale scale(plan, motion, *work.tolerance);
  constexpr double contact_round_off = 1e-12;  // [m], [m/s]
  scale.position = std::max(scale.position, contact_round_off);
  scale.velocity = std::max(scale.velocity, 10.0 * contact_round_off);
  store(motion, before_);
  while (true) {
    const StepCounters before(motion, force_work);
    const double h = advance_freely(plan, method, motion, work, interval, before_.damping, force_work);
    if (h == 0.0) return 0.0;
    const bool ends = h == left;
    if (!correct(plan, before_, motion, h, ends, force_work)) return h;

    std::ranges::copy(motion.x, coarse_x_.begin());
    std::ranges::copy(motion.v, coarse_v_.begin());
    const double free_step = motion.memory.step;
    restore(before_, motion);
    restore(before, 0.5 * h, motion, force_work);
    if (advance_in_pieces(plan, method, motion, work, h, ends, force_work) == 0.0) return 0.0;

    const double position = difference(plan, coarse_x_, motion.x) / 3.0, velocity = difference(plan, coarse_v_, motion.v) / 3.0;
    const double error = scale.relative(position, velocity);
    if (!std::isfinite(error)) return 0.0;
    constexpr double safety = 0.9, min_factor = 0.1, max_factor = 2.0;
    const double factor = error == 0.0 ? max_factor : std::clamp(safety * portable::pow(error, -1.0 / 3.0), min_factor, max_factor);
    if (error <= 1.0 || h <= work.min_step) {
      motion.local_error += position;
      // a step truncated by the end of the interval says little about the next one
      const double contact_step = factor == max_factor ? std::max(before.memory.step, max_factor * h) : factor * h;
      motion.memory.step = std::max(work.min_step, std::min(free_step, contact_step));
      if (ends_free_) motion.memory.step = std::max(motion.memory.step, free_step_);
      free_step_ = 0.0;
      return h;
    }

    // an impact: a step that ends before it, by a quarter of the length required for the contact, so that the impact is in the first half
    // of the next step
    const double contact_step = std::max(work.min_step, factor * h);
    constexpr int max_attempts = 4;  // each with the impact located by the shorter step before
    double impact = first_touch_;
    for (int attempt = 0; attempt < max_attempts && std::isfinite(impact) && impact > 2.0 * contact_step; ++attempt) {
      restore(before_, motion);
      restore(before, h, motion, force_work);
      const double jump = impact - 0.25 * contact_step,
                   length = advance_freely(plan, method, motion, work, jump, before_.damping, force_work);
      if (length == 0.0) return 0.0;
      if (!correct(plan, before_, motion, length, false, force_work)) {
        free_step_ = std::max(free_step_, h);
        if (length == jump) motion.memory.step = contact_step;
        return length;
      }
      impact = before_.first_touch;
    }
    restore(before_, motion);
    restore(before, contact_step, motion, force_work);
  }
}

}  // namespace hooke
