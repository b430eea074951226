// Books on a run, frame by frame: what its solves, its energy and its steps say against trusting it. What a run gets
// wrong shall not stay unsaid.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sim/motion.h"
#include "sim/settings.h"
#include "sim/state.h"
#include "sim/system.h"

namespace hooke {

// From which size on a fault counts.
struct Tolerance {
  double energy = 0.02;                                       // [1], of what was put in, from nowhere or, undamped, lost
  double position = std::numeric_limits<double>::infinity();  // [m], of the errors of all frames, as estimated
};

class RunMonitor {
 public:
  // Before every so manieth frame its error is estimated, which costs as much as three frames; 0: never.
  RunMonitor(const System& system, const State& start, int frames_per_estimate);

  // Whether the coming frame's error will be estimated.
  bool estimate_is_due() const { return frames_per_estimate_ != 0 && frames_ % frames_per_estimate_ == 0; }
  // Before and after a frame, with its edits already applied to `system`.
  void begin_frame(const System& system, const Settings& settings, const State& state);
  void end_frame(const System& system, const State& state, const Motion& motion);

  long unconverged_solves() const { return unconverged_solves_; }
  // The furthest that the energy, less what the hand, forces and edits gave, rose above an earlier value, of what was put in
  // [1]: nothing physical does.
  double energy_rise() const { return largest_rise_ / scale_; }
  // How far it is from where it started, of what was put in [1]: without damping and colliders the method's own doing.
  double energy_change() const { return (energy_ - start_energy_) / scale_; }
  // Sum of the frames' errors [m], as estimated every so often; an error grows or fades after it was made.
  double estimated_error() const { return estimated_error_; }

  // What speaks against the run, a clause each; empty: nothing.
  std::vector<std::string> warnings(const System& system, const Tolerance& tolerance) const;

 private:
  const int frames_per_estimate_;
  long frames_ = 0, unconverged_solves_ = 0;
  double start_energy_, energy_, lowest_energy_;  // [J], less what was given
  double largest_rise_ = 0.0;                     // [J]
  double scale_;                                  // [J]
  double estimated_error_ = 0.0;                  // [m]
};

}  // namespace hooke
