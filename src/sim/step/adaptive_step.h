// Steps of methods that choose their own, with the contacts in them under the same error control.
#pragma once

#include "sim/contact/contact.h"
#include "sim/forces/energy/force_work.h"
#include "sim/forces/motion.h"
#include "sim/methods/error_scale.h"
#include "sim/methods/integrator.h"

namespace hooke {

// Of a frame, those of rejected steps included.
inline constexpr long max_adaptive_evaluations = 2'000'000;
// The same for steps with contact of faces or springs, each of which costs as much as hundreds of force evaluations.
inline constexpr long max_adaptive_surface_steps = 5'000;

// What a step adds to or overwrites besides positions and velocities, for steps that are taken back.
struct StepCounters {
  MethodMemory memory;
  double collider_work, contact_work, hand_work, abs_hand_work, limit_work, limit_gain, force_work, reversible_work, drag_work,
      dashpot_work, local_error;
  ForceWork::Memory forces;
  StepCounters(const Motion& motion, const ForceWork& work);
  void restore(Motion& motion, ForceWork& work) const;
};

// Where nothing touches a collider, the method's own error estimate decides. If a tolerance is set, it applies to contact too: a step in
// which anything touches is repeated in pieces, which halve the time that follows each impact and what is at rest. Contact is resolved to
// second order in that time, so a third of their difference is the error of the finer result, which is kept if that is within the
// tolerance. Otherwise an impact is an event: it is located, a step of the method ends just before it, a short one leads through it, and
// the steps continue with the length that they had before. Where the first contact is not an impact, such as a slide, the step is repeated,
// shorter. Friction, which is of first order, makes this expensive: without a tolerance, contact is resolved once per step.
class AdaptiveStep {
 public:
  // Of the coming frames.
  void limit_evaluations(long max) { max_evaluations_ = max; }
  // Once a frame; a step never allocates.
  void begin_frame(const Plan& plan, Motion& motion, Workspace& work);
  // Advances the motion by one step of at most `interval` [s], with contacts and, if it leads to the end of the substep, `left` [s] away,
  // the strain limit, and adds the work of the listed forces. Leaves motion.time. Returns the length of the step; 0: no step is short
  // enough for a finite error.
  double advance(const Plan& plan, const Integrator& method, Motion& motion, Workspace& work, double interval, double left,
                 ForceWork& force_work);
  // Whether one of the limits of the frame is reached.
  bool is_at_limit(const Motion& motion) const {
    return motion.counts.force_evaluations >= max_evaluations_ || surface_steps_ >= max_adaptive_surface_steps;
  }
  bool has_too_many_pairs() const { return before_.has_too_many_pairs() || piece_.has_too_many_pairs(); }

 private:
  bool correct(const Plan& plan, ContactWorkspace& before, Motion& motion, double h, bool ends, ForceWork& force_work);
  double advance_in_pieces(const Plan& plan, const Integrator& method, Motion& motion, Workspace& work, double h, bool ends,
                           ForceWork& force_work);
  double difference(const Plan& plan, Field& coarse, const Field& fine) const;

  ContactWorkspace before_, piece_;
  Field coarse_x_, coarse_v_;
  double first_touch_ = 0.0;  // [s], since the start of the last step in pieces
  bool ends_free_ = false;    // whether nothing touched in its last part
  double free_step_ = 0.0;    // [s], step before the impact to which the last step led; 0: it led to none
  long max_evaluations_ = max_adaptive_evaluations;
  long surface_steps_ = 0;  // of the frame, with contact of faces or springs
};

}  // namespace hooke
