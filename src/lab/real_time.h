// How simulated time keeps up with real time: what is owed to it, and how fast it has gone of late.
#pragma once

namespace hooke {

class RealTime {
 public:
  void reset() { *this = {}; }

  // Real time has passed, which asks for `speed` times as much simulated time.
  void ask(double real_seconds, double speed);
  bool owes(double frame) const { return owed_ >= frame; }
  void pay(double frame) { owed_ -= frame; }
  // What is owed beyond a frame is not made up for: the scene runs slower, and says so.
  void settle(double real_seconds, double simulated_seconds, double frame);
  void forgive() { owed_ = 0.0; }

  // [s] of simulated time until the next frame is due.
  double time_to_next(double frame) const { return frame - owed_; }
  // [1], simulated per real second, of late; 0: nothing has passed.
  double speed() const { return recent_real_ > 0.0 ? recent_simulated_ / recent_real_ : 0.0; }

 private:
  double owed_ = 0.0;                                  // [s] of simulated time not yet stepped
  double recent_simulated_ = 0.0, recent_real_ = 0.0;  // [s], fading sums
};

}  // namespace hooke
