// Computes frames with any method: whoever steps (the laboratory, runs beside it, benchmarks, studies) uses one of these. With `auto` it
// computes each frame with two numbers of substeps, estimates its error, and repeats it with more until the tolerance is met.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "sim/control/cost_model.h"
#include "sim/control/error_estimator.h"
#include "sim/control/method_selector.h"
#include "sim/methods/automatic_method.h"
#include "sim/step/step.h"

namespace hooke {

// A frame in progress, used as a Frame (step/step.h). The System must exist until `end`.
class FrameRunner {
 public:
  void begin(Plan& plan, const System& system, const Settings& settings, const State& state);
  void substep(Plan& plan);
  // The scene was edited: `auto` estimates the next frame.
  void expect_change() { is_edited_ = true; }
  // Whether that has not taken effect yet; afterwards it does not.
  bool take_change() { return std::exchange(is_edited_, false); }
  bool done() const { return frame_.done() && (!is_automatic_ || is_accepted_); }
  void end(const Plan& plan, State& state) const;

  StepFailure failure() const { return frame_.failure(); }
  int substeps_done() const { return frame_.substeps_done(); }
  double duration() const { return frame_.duration(); }  // [s]
  bool has_touched() const { return frame_.has_touched(); }
  std::span<const Index> broken() const { return frame_.broken(); }
  void limit_evaluations(long max) { frame_.limit_evaluations(max); }
  // Of the run that was kept.
  long force_evaluations() const { return frame_.force_evaluations(); }
  long factorizations() const { return frame_.factorizations(); }
  const Motion& motion() const { return frame_.motion(); }
  // [ms], by the model of the cost: of the run that is in progress or kept, and of all others so far.
  double cost(const Plan& plan) const;
  double trial_cost() const { return other_cost_ + selector_.total_cost(); }

 private:
  void choose(Plan& plan);
  void select(Plan& plan);
  void start(Plan& plan, int substeps);
  void start_runs(Plan& plan, int substeps);
  void finish_run(Plan& plan);
  void judge(Plan& plan);
  void accept(std::optional<double> error, double controlled, int order);
  double max_cost(const Plan& plan) const;
  double max_cost_of_events(const Plan& plan) const;
  int affordable_substeps(const Plan& plan, int wanted) const;

  Frame frame_;
  MethodSelector selector_;
  StepLimits limits_{Spectrum{}};
  bool is_automatic_ = false, is_accepted_ = false;
  bool is_edited_ = false;  // since the last frame
  const System* system_ = nullptr;
  State start_;
  Settings settings_;
  MethodChoice choice_;                                          // of this frame
  bool is_estimated_ = false;                                    // this frame
  FrameRuns runs_;                                               // of this frame
  int rejections_ = 0;                                           // in this frame
  bool agreed_before_ = false;                                   // the last two runs, with half of the substeps of the present pair
  double share_ = 0.0;                                           // [m], of the tolerance
  double max_cost_ = 0.0, frame_cost_ = 0.0, other_cost_ = 0.0;  // [ms]: allowed to this frame, of all its runs; of runs not kept
  State scratch_;
};

}  // namespace hooke
