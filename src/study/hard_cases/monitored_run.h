// Runs a scene under a method in its own Lab, as the window does: with the divergence check, and with a RunMonitor.
#pragma once

#include <optional>
#include <string>

#include "base/formatted.h"
#include "lab/lab.h"
#include "sim/control/automatic.h"
#include "study/benchmark.h"
#include "study/hard_cases/hard_case.h"
#include "study/hard_cases/test_network.h"
#include "study/run_monitor.h"

namespace hooke {

// Stops all runs on all threads: the next frame of each throws Interrupted.
void set_interrupted(bool stop);
struct Interrupted {};

// [m/s], of `auto` where a case sets no other.
inline constexpr double automatic_case_tolerance = 1e-5;

class MonitoredRun {
 public:
  // With a tolerance for positions the errors of the frames are estimated.
  MonitoredRun(const TestNetwork& network, const Settings& settings, const Tolerance& tolerance = {});

  // Steps one frame. Returns false when the run has diverged, and from then on.
  bool frame();
  // Steps the whole frames within `seconds`.
  bool run(double seconds);

  Lab& lab() { return lab_; }
  const System& system() const { return lab_.scene().system; }
  const State& state() const { return lab_.scene().state; }
  const Settings& settings() const { return lab_.scene().settings; }
  const RunMonitor& monitor() const { return *monitor_; }
  bool stopped() const { return stopped_; }

  // How the run itself reports a failure: it diverged, its step is beyond the limit of the method, `auto` did not meet its tolerance, or
  // the monitor warns. Empty: no failure is reported.
  std::string report() const;

 private:
  Lab lab_;
  const Tolerance tolerance_;
  std::optional<RunMonitor> monitor_;
  ToleranceMonitor missed_;
  bool stopped_ = false;
  std::string stop_reason_;  // as reported; empty: it did not stop, or without a complete report
};

// The settings of a method on a scene: 60 frames per second, with the minimum number of stable substeps.
struct Stepping {
  int min = 1;            // minimum number of substeps
  int free = 1;           // substeps of methods stable at any step
  double fraction = 1.0;  // step as a fraction of the largest stable one
  int max = 1000000;      // substeps: if more are needed, the run is too expensive and gets `min`
};
Settings settings_for(const Integrator& method, const System& system, const Stepping& stepping = {});

// Whether the method is stable at any step, at least for a single spring.
bool is_stable_at_any_step(const Integrator& method);

// A run must succeed, unless its step is beyond the limit of its method, or the method guarantees nothing: XPBD with many springs; the
// implicit midpoint rule, which damps nothing, with rotating springs that are too fast for the step.
Expectation expectation_of(const MonitoredRun& run);

// The verdict on a run whose criterion was `met` or not.
Verdict judge(const MonitoredRun& run, bool met, std::string measured);
Verdict judge(const MonitoredRun& run, Expectation expected, bool met, std::string measured);

}  // namespace hooke
