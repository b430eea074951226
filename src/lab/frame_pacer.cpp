#include "lab/frame_pacer.h"

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

// The maximum real time counted per call [s]. Without it, a window that was hidden would resume with a jump.
constexpr double max_real_seconds = 0.25;

// [s] over which the displayed speed is measured.
constexpr double speed_window = 1.0;

}  // namespace

void FramePacer::accumulate(double real_seconds, double speed) { backlog_ += std::min(real_seconds, max_real_seconds) * speed; }

void FramePacer::update_speed(double real_seconds, double simulated_seconds, double frame) {
  backlog_ = std::clamp(backlog_, 0.0, frame);
  const double fade = std::exp(-real_seconds / speed_window);
  recent_simulated_ = fade * recent_simulated_ + simulated_seconds;
  recent_real_ = fade * recent_real_ + real_seconds;
}

}  // namespace hooke
