#include "lab/run_clock.h"

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

// The maximum real time counted per call [s]. Without it, a window that was hidden would resume with a jump.
constexpr double max_real_seconds = 0.25;

// [s] over which the displayed speed is measured.
constexpr double speed_window = 1.0;

}  // namespace

void RunClock::set_running(bool running) {
  running_ = running;
  run_to_.reset();
}

void RunClock::run_to(double from, double to) {
  running_ = true;
  run_from_ = from;
  run_to_ = to;
}

void RunClock::reset_pace() { backlog_ = recent_simulated_ = recent_real_ = 0.0; }

void RunClock::accumulate(double real_seconds, double speed) {
  if (running_) backlog_ += std::min(real_seconds, max_real_seconds) * speed;
}

void RunClock::update_speed(double real_seconds, double simulated_seconds, double frame) {
  backlog_ = std::clamp(backlog_, 0.0, frame);
  const double fade = std::exp(-real_seconds / speed_window);
  recent_simulated_ = fade * recent_simulated_ + simulated_seconds;
  recent_real_ = fade * recent_real_ + real_seconds;
}

void RunClock::end_frame(double time, double frame) {
  // the scene's clock is a sum of frame durations: compare with a tolerance of half a frame
  if (run_to_ && time + 0.5 * frame > *run_to_) set_running(false);
}

}  // namespace hooke
