#include "lab/accuracy/frame_repetition.h"

#include "sim/energy.h"

namespace hooke {

void FrameRepetition::begin(const Plan& plan, const System& system, const Settings& settings, const State& before, const State& after,
                            double energy) {
  run_.set_plan(plan);
  run_.start(before);
  const Repetition repetition = repetition_of(plan, system, settings);
  run_.begin_frame(system, repetition.settings, before.time, before.hand);
  end_ = after.position;
  time_ = after.time;
  energy_ = energy;
  weight_ = repetition.weight;
}

void FrameRepetition::substep(const System& system) {
  run_.substep();
  if (run_.is_in_frame()) return;
  result_.reset();
  if (run_.failed()) return;
  result_ = Result{.error = weighted_distance(end_, run_.state().position, weight_),
                   .time = time_,
                   .numerical_gain = weight_ * (energy_ - compute_energy(system, run_.state()).total())};
}

void FrameRepetition::reset() {
  cancel();
  result_.reset();
}

}  // namespace hooke
