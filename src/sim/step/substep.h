// The substeps of a frame: method, hand, strain limit, contact and springs that break, in this order.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/forces/energy/power_work.h"
#include "sim/forces/terms/sticking.h"
#include "sim/methods/integrator.h"
#include "sim/model/settings.h"
#include "sim/step/adaptive_step.h"

namespace hooke {

// Why a frame ended early: for an adaptive method no step is short enough for a finite error, or a frame takes more than
// max_adaptive_evaluations force evaluations or max_adaptive_surface_steps, those of rejected steps included; or more than
// PairSolver::max_pairs pairs of points come within reach of each other in one substep, or these hit each other, or surfaces move, so that
// the search for impacts does not end; or an implicit method needs a factor of more than max_factor_entries.
enum class StepFailure { None, TooShort, TooMany, TooManyPairs, MatrixTooLarge };

class Substep {
 public:
  // Once a frame, with its method and its motion as packed; a step never allocates.
  void begin_frame(Plan& plan, const Settings& settings, Motion& motion);

  // Leads on by a substep, of which `done` are done; where nothing acts between them, by several; by a part of one where a
  // method chooses its steps or a break is located. Returns how many were completed.
  int advance(Plan& plan, Motion& motion, int done);

  StepFailure failure() const { return failure_; }
  // Whether any point touched a collider or another point in this frame, and whether any did so with a velocity that ended.
  bool has_touched() const { return has_touched_; }
  bool has_impact() const { return has_impact_; }
  // Indices in the System of springs that broke in this frame, in ascending order.
  std::span<const Index> broken() const { return broken_; }
  const Integrator& method() const { return *method_; }
  // Of a method that chooses its steps, for the coming frames.
  void limit_evaluations(long max) { adaptive_.limit_evaluations(max); }

 private:
  bool is_adaptive() const { return method_->advance != nullptr; }
  double time_after(int substeps) const { return start_ + substeps * h_; }
  void prepare_method(const Plan& plan, double h, const Motion& motion);
  double next_length(const Plan& plan, const Motion& motion) const;
  double step(Plan& plan, Motion& motion, int done, bool& is_moved);
  bool step_by_method(const Plan& plan, Motion& motion, double length);
  bool correct(const Plan& plan, Motion& motion, double h);
  void break_long_springs(Plan& plan, Motion& motion);
  int take_several(const Plan& plan, Motion& motion, int done);

  const Integrator* method_ = nullptr;
  double start_ = 0.0, h_ = 0.0;  // [s], of the frame and of a substep
  int count_ = 0;                 // substeps of the frame
  double left_ = 0.0;             // [s], of the substep in progress
  double prepared_ = 0.0;         // [s], the step for which the method is prepared
  bool locates_breaks_ = false;
  bool has_touched_ = false, has_impact_ = false;
  StepFailure failure_ = StepFailure::None;
  Workspace work_;
  ContactWorkspace before_;  // the start of the substep
  AdaptiveStep adaptive_;
  PowerWork works_;
  Sticking sticking_;
  std::vector<Index> broken_;
};

}  // namespace hooke
