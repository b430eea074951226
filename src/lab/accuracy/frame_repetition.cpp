#include "lab/accuracy/frame_repetition.h"

namespace hooke {

void FrameRepetition::begin(const Plan& plan, const System& system, const Settings& settings, const State& before, const State& after,
                            long evaluations, bool measures_order) {
  run_.set_plan(plan);
  run_.limit_cost(evaluations);
  run_.start(before);
  const Repetition repetition = repetition_of(plan, system, settings);
  run_.begin_frame(system, repetition.settings, before.time, before.hand);
  end_ = after.position;
  time_ = after.time;
  weight_ = repetition.weight;
  by_half_.reset();
  before_.reset();
  if (!measures_order || repetition.is_resolving) return;
  before_ = before;
  quarter_ = refined(system, repetition.settings);
}

void FrameRepetition::substep(const System& system) {
  run_.substep();
  if (run_.is_in_frame()) return;
  if (by_half_) {
    if (!run_.failed()) result_->refinement = {*by_half_, weighted_distance(system, end_, run_.state().position, 1.0).rms};
    by_half_.reset();
    return;
  }
  result_.reset();
  has_failed_ = run_.failed();
  if (has_failed_) return;
  result_ = Result{.error = weighted_distance(system, end_, run_.state().position, weight_), .time = time_};
  if (!before_) return;
  by_half_ = result_->error.rms / weight_;
  end_ = run_.state().position;
  run_.start(*before_);
  run_.begin_frame(system, quarter_, before_->time, before_->hand);
}

void FrameRepetition::reset() {
  run_.stop();
  result_.reset();
  has_failed_ = false;
}

}  // namespace hooke
