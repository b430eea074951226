// A scene under a method in a Lab of its own, frame by frame, as a person would see it: with the watch for divergence,
// and with books on what speaks against it.
#pragma once

#include <optional>
#include <string>

#include "lab/lab.h"
#include "study/hard_cases/hard_case.h"
#include "study/hard_cases/test_network.h"
#include "study/run_monitor.h"

namespace hooke {

// Whether all runs, on whatever thread, are to stop: then the next frame of each throws Interrupted.
void set_interrupted(bool stop);
struct Interrupted {};

class MonitoredRun {
 public:
  // With a tolerance for positions the frames' errors are estimated.
  MonitoredRun(const TestNetwork& network, const Settings& settings, const Tolerance& tolerance = {});

  // One frame; false when the watch stops the run, and from then on.
  bool frame();
  // As many whole frames as `seconds` hold.
  bool run(double seconds);

  Lab& lab() { return lab_; }
  const System& system() const { return lab_.scene().system; }
  const State& state() const { return lab_.scene().state; }
  const Settings& settings() const { return lab_.scene().settings; }
  const RunMonitor& monitor() const { return *monitor_; }
  bool stopped() const { return stopped_; }

  // How the run itself says that it is not to be trusted: the watch stopped it; its step is beyond the method's limit; or
  // its books do. Empty: in no way.
  std::string report() const;

 private:
  Lab lab_;
  const Tolerance tolerance_;
  std::optional<RunMonitor> monitor_;
  bool stopped_ = false;
  std::string stop_reason_;  // how the watch named it; empty: not openly, or not at all
};

// How a method is set on a scene: at 60 frames a second, with the fewest substeps at which it holds.
struct Stepping {
  int min = 1;            // substeps, at least
  int free = 1;           // substeps of the methods that hold at any step
  double fraction = 1.0;  // of the largest stable step, that may be taken
  int max = 1000000;      // substeps: where it takes more, these are too dear, and it is left at `least`
};
Settings settings_for(const Integrator& method, const System& system, const Stepping& stepping = {});

// Whether a step of any size may be asked of the method, if only for a spring alone.
bool is_stable_at_any_step(const Integrator& method);
// Whether it picks its steps itself.
bool adapts(const Integrator& method);

// A run must hold, unless its step is beyond the limit of its method, or the method promises nothing: many springs at a
// time under XPBD; springs that turn, and are too fast for the step, under the midpoint rule, which damps nothing.
Expectation expectation_of(const MonitoredRun& run);

// The verdict on a run that was to meet a criterion, and did (`met`) or not.
Verdict judge(const MonitoredRun& run, bool met, std::string measured);
Verdict judge(const MonitoredRun& run, Expectation expected, bool met, std::string measured);

std::string text(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

}  // namespace hooke
