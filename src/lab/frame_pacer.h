// How simulated time keeps up with real time: what is owed to it, and how fast it has gone of late.
#pragma once

namespace hooke {

class FramePacer {
 public:
  void reset() { *this = {}; }

  // Real time has passed, which asks for `speed` times as much simulated time.
  void accumulate(double real_seconds, double speed);
  bool has_frame_due(double frame) const { return backlog_ >= frame; }
  void consume(double frame) { backlog_ -= frame; }
  // What is owed beyond a frame is not made up for: the scene runs slower, and says so.
  void update_speed(double real_seconds, double simulated_seconds, double frame);
  void clear_backlog() { backlog_ = 0.0; }

  // [s] of simulated time until the next frame is due.
  double time_to_next(double frame) const { return frame - backlog_; }
  // [1], simulated per real second, of late; 0: nothing has passed.
  double speed() const { return recent_real_ > 0.0 ? recent_simulated_ / recent_real_ : 0.0; }

 private:
  double backlog_ = 0.0;                               // [s] of simulated time not yet stepped
  double recent_simulated_ = 0.0, recent_real_ = 0.0;  // [s], fading sums
};

}  // namespace hooke
