// When frames are due: whether the laboratory runs, how far, and the pace of simulated time by real time.
#pragma once

#include <optional>

namespace hooke {

class RunClock {
 public:
  bool is_running() const { return running_; }
  // Runs in real time, or stops; a run to a given time ends.
  void set_running(bool running);
  // Runs as fast as possible from one time of the scene to another [s].
  void run_to(double from, double to);
  // From where to where it runs as fast as possible [s]; both 0: it does not.
  double from() const { return run_to_ ? run_from_ : 0.0; }
  double to() const { return run_to_.value_or(0.0); }

  // Forgets what is due, and the measured speed and times.
  void reset_pace();
  void clear_backlog() { backlog_ = 0.0; }
  // Adds `speed` times the elapsed real time to what is due.
  void accumulate(double real_seconds, double speed);
  // Whether a frame of this duration [s] is due, and that it was computed.
  bool has_frame_due(double frame) const { return running_ && (run_to_ || backlog_ >= frame); }
  void consume(double frame) { backlog_ -= frame; }
  // Limits the backlog to one frame, so that a slow scene runs slower instead of catching up, and measures the speed.
  void update_speed(double real_seconds, double simulated_seconds, double frame);

  // A frame was computed that ends at a time of the scene [s]: a run to that time stops.
  void end_frame(double time, double frame);

  // [s] of simulated time until the next frame is due.
  double time_to_next(double frame) const { return run_to_ ? 0.0 : frame - backlog_; }
  // [1], simulated seconds per real second, over about the last second; 0: not measured.
  double speed() const { return running_ && recent_real_ > 0.0 ? recent_simulated_ / recent_real_ : 0.0; }

 private:
  bool running_ = false;
  std::optional<double> run_to_;                       // [s]
  double run_from_ = 0.0;                              // [s]
  double backlog_ = 0.0;                               // [s] of simulated time not yet stepped
  double recent_simulated_ = 0.0, recent_real_ = 0.0;  // [s], fading sums
};

}  // namespace hooke
