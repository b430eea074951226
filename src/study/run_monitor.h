// Monitors a run frame by frame and warns if its solves, its energy balance or its error estimates indicate a failure.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "study/energy_monitor.h"

namespace hooke {

// Limits above which the monitor warns.
struct Tolerance {
  double energy = 0.02;  // [1], of the supplied energy: gained, or lost beyond what the scene may dissipate
  double position = std::numeric_limits<double>::infinity();  // [m], estimated error of all frames together
};

class RunMonitor {
 public:
  // `plan`: of `system`. The error of every `frames_per_estimate`-th frame is estimated, at the cost of three frames; 0: never.
  RunMonitor(const Plan& plan, const Settings& settings, const System& system, const State& start, int frames_per_estimate);

  // Whether the error of the next frame will be estimated.
  bool estimate_is_due() const { return frames_per_estimate_ != 0 && frames_ % frames_per_estimate_ == 0; }
  // Must be called before and after a frame, with its edits already applied to `system`.
  void begin_frame(const System& system, const Settings& settings, const State& state);
  // `plan`: of `system` after the frame. `motion`: that of the frame, as it ended.
  void end_frame(const Plan& plan, const Settings& settings, const System& system, const State& state, const Motion& motion);

  // How many edges pass through faces, or springs of flat scenes through each other, at `time` [s]. In 3-D scenes those at the starts of
  // frames are known from `end_frame`, in flat ones those at the start of the run; to be called at the end of the run.
  void note_crossings(long crossings, double time);

  long unconverged_solves() const { return unconverged_solves_; }
  // Maximum rise of the energy, minus the work of the hand, forces and edits, above an earlier value, relative to the supplied energy [1].
  // No physical process causes one. A symplectic method lets the energy oscillate about its modified energy, which is no error of the
  // motion of that size: where the modified energy is known (Integrator::modified_energy), the smaller rise of the two counts.
  double energy_rise() const { return energy_.rise(); }
  // Sum of the estimated errors of the frames [m], ignoring their later growth or decay.
  double estimated_error() const { return estimated_error_; }

  // One clause per warning; empty: none.
  std::vector<std::string> warnings(const Tolerance& tolerance) const;

 private:
  const int frames_per_estimate_;
  long frames_ = 0, unconverged_solves_ = 0;
  struct Crossings {
    std::optional<long> first;  // none: not known yet
    long max = 0;
    double time = 0.0;  // [s], when there were first some
  };
  Crossings crossings_;
  EnergyMonitor energy_;
  double estimated_error_ = 0.0;  // [m]
};

}  // namespace hooke
