// Runs a scene for some time and reports samples of it: `hooke run`, and `run` of the Python module.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lab/lab.h"

namespace hooke {

// Thrown by a laboratory's watch_substeps: ends a run, a replay or a capture with its last complete frame.
struct Interrupted {};

struct RunRequest {
  double seconds = 0.0;  // [s], rounded up to whole frames
  // [s]: samples at the start and at the end of the first frame at or after each multiple, without interpolation; none: only the last state
  std::optional<double> sample{};
  AccuracyMode accuracy = AccuracyMode::Off;
};

// Totals of a finished run.
struct RunTotals {
  double seconds = 0.0;                          // simulated
  long frames = 0;                               // of a replay, without one that diverged
  double cpu_seconds = 0.0, wall_seconds = 0.0;  // of the run, without measuring its accuracy
  double accuracy_cpu_seconds = 0.0;             // of that
  bool diverged = false, interrupted = false;
  std::optional<long> frames_beyond_tolerance;  // with the method `auto` at the end
  std::vector<double> gas_releases{};           // [s], when tears opened surfaces filled with gas
  long force_evaluations = 0, factorizations = 0;
  std::uint64_t hash = 0;  // of the last state
};

struct RunHooks {
  // Receives each sample. After a divergence the last sample is the last valid state.
  std::function<void(const State& state, const Accuracy& accuracy)> sample{};
  // Called at the start and after every frame; false ends the run with a sample of the present state.
  std::function<bool()> frame{};
  // Called after every frame.
  std::function<void(long done, long all)> progress{};
};

struct RunResults {
  RunTotals totals;
  std::vector<std::string> warnings;  // of the monitored energy and solves and of the accumulated error, one clause each
  // A state one to two seconds, or two frames, before the last one; null: the run was shorter, or the scene is too large for a search for a
  // remedy to come from that state to the last one.
  std::shared_ptr<const State> before_end;
};

// The number of frames that cover `seconds`, tolerating rounding errors. Throws UsageError if there are too many.
long count_frames(double seconds, double frame_rate);

// Whether `sample` is called for this frame, counted from 0 at the start.
class SampleClock {
 public:
  SampleClock(std::optional<double> spacing, double frame_rate, long frames);
  bool is_due(long frame);
  // At least the number of samples of a run that does not diverge, and at most two more.
  static long max_count(std::optional<double> spacing, double frame_rate, long frames);

 private:
  double frames_per_sample_, next_ = 0.0;
  long last_;
};

// Replays the recording in a laboratory without a start, to its end or to the first frame that differs; the request's `seconds` are not
// used. Samples are taken as in a run, by the frame rate at the start; where the replay ends early, the last one is of its last valid
// state. Throws UsageError.
RunTotals replay_frames(Lab& lab, const std::shared_ptr<const Recording>& recording, const RunRequest& request, const RunHooks& hooks);

// Runs the scene of the laboratory from its present state. The hooks may submit commands.
RunResults run_frames(Lab& lab, const RunRequest& request, const RunHooks& hooks);

}  // namespace hooke
