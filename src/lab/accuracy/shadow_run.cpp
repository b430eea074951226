#include "lab/accuracy/shadow_run.h"

namespace hooke {

void ShadowRun::begin_frame(const System& system, const Settings& settings, double time, const Hand& hand) {
  state_.time = time;
  state_.hand = hand;
  frame_.begin(plan_, system, settings, state_);
  is_in_frame_ = true;
}

void ShadowRun::substep() {
  // `auto` may have computed all of the frame when it chose the method
  if (!frame_.done()) frame_.substep(plan_);
  if (!frame_.done()) return;
  frame_.end(plan_, state_);
  is_in_frame_ = false;
}

}  // namespace hooke
