#include "sim/step/step.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/model/grab.h"
#include "sim/step/constants.h"

namespace hooke {

namespace {

// A method that linearizes the springs over a step stretches those that rotate, by up to the displacement of the hand: energy that comes
// from no force and that the next steps remove.
double stretch_energy(const System& system, double displacement) {
  double stiffness = 0.0;
  for (const Spring& spring : system.springs()) stiffness += system.stiffness_bound_of(spring);
  return 0.5 * stiffness * displacement * displacement;
}

// A held point moves in a straight line to the target, as a point of infinite mass with that velocity: exact for every method.
HandMotion move_hand(const Plan& plan, const System& system, const State& state, double duration, int substeps, Motion& motion) {
  HandMotion hand;
  if (plan.collider_paths.grabbed) hand.collider_displacement = duration * plan.collider_paths.grabbed->velocity;
  const std::optional<ActiveGrab> grab = active_grab(system, state, duration);
  Vec3 displacement(0.0);
  if (grab) {
    const Vec3 from = system.grab ? state.hand.position : state.position[system.index_of(grab->point)];
    hand.target = clamp_hand_target(system, from, grab->target, duration);
    displacement = hand.target - (plan.hand.held ? state.position[*plan.hand.held] : from);
    hand.stretch = stretch_energy(system, glm::length(displacement) / substeps);
  }
  hand.speed = (glm::length(displacement) + glm::length(hand.collider_displacement)) / duration;
  if (plan.hand.held) {
    const Index held = *plan.hand.held;
    const Vec3 velocity = displacement / duration;
    set_vector(plan, motion.v, held, velocity);
    // what is along a fixed axis of a roller has no energy, as on nails
    const Vec3 after = free_part(plan, held, velocity), before = free_part(plan, held, state.velocity[held]);
    motion.energy.add(EnergyCause::Hand, 0.5 * plan.hand.held_mass * (glm::dot(after, after) - glm::dot(before, before)));
  }
  return hand;
}

}  // namespace

void Frame::begin(Plan& plan, const System& system, const Settings& settings, const State& state) {
  duration_ = 1.0 / settings.frame_rate;
  prepare_hand(plan, system, state, duration_);
  substeps_ = settings.substeps;
  substeps_done_ = 0;
  start_ = state.time;
  pack(plan, state, motion_);
  hand_ = move_hand(plan, system, state, duration_, substeps_, motion_);
  substep_.begin_frame(plan, settings, motion_);
}

void Frame::substep(Plan& plan) { substeps_done_ += substep_.advance(plan, motion_, substeps_done_); }

void Frame::end(const Plan& plan, State& state) const {
  unpack(plan, motion_, state);
  // a multiple of the frame duration stays one: rounding errors do not accumulate over a long run
  const double frames = (start_ + duration_) / duration_;
  const bool is_multiple = std::abs(frames - std::round(frames)) < frame_time_tolerance;
  state.time = is_multiple ? std::round(frames) * duration_ : start_ + duration_;

  state.hand.position = hand_.target;
  if (auto& carried = state.hand.collider) carried->shape = translated(carried->shape, hand_.collider_displacement);
  if (plan.hand.held)
    for (int c = 0; c < plan.dimensions; ++c) state.position[*plan.hand.held][c] = hand_.target[c];
  record_frame_energy(plan, explained(motion_.energy, plan.hand.held || plan.collider_paths.any_moves), hand_, state);
}

}  // namespace hooke
