// Paces simulated time by real time: the backlog, and the measured speed.
#pragma once

namespace hooke {

class FramePacer {
 public:
  void reset() { *this = {}; }

  // Adds `speed` times the elapsed real time to the backlog.
  void accumulate(double real_seconds, double speed);
  bool has_frame_due(double frame) const { return backlog_ >= frame; }
  void consume(double frame) { backlog_ -= frame; }
  // Limits the backlog to one frame, so that a slow scene runs slower instead of catching up, and measures the speed.
  void update_speed(double real_seconds, double simulated_seconds, double frame);
  void clear_backlog() { backlog_ = 0.0; }

  // [s] of simulated time until the next frame is due.
  double time_to_next(double frame) const { return frame - backlog_; }
  // [1], simulated seconds per real second, over about the last second; 0: not measured.
  double speed() const { return recent_real_ > 0.0 ? recent_simulated_ / recent_real_ : 0.0; }

 private:
  double backlog_ = 0.0;                               // [s] of simulated time not yet stepped
  double recent_simulated_ = 0.0, recent_real_ = 0.0;  // [s], fading sums
};

}  // namespace hooke
