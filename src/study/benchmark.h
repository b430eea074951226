// Runs methods on a problem: from the start through four snapshots at one setting, counting CPU time and work.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/control/frame_runner.h"
#include "sim/methods/integrator.h"
#include "sim/plan/plan.h"
#include "study/problem.h"

namespace hooke {

// The duration of a problem is divided into this many equal parts, with a snapshot at the end of each.
inline constexpr int snapshot_count = 4;

// Whether the method chooses its own steps by a tolerance.
bool is_adaptive(const Integrator& method);

// Steps in a frame, or the tolerance [m] of an adaptive method.
struct Setting {
  int steps = 1;
  std::optional<double> tolerance;
  bool operator==(const Setting&) const = default;
};

// The work of a run, independent of the machine.
struct WorkCounts {
  long force_evaluations = 0, factorizations = 0, solves = 0, sweeps = 0;
  bool operator==(const WorkCounts&) const = default;
};

struct RunResult {
  enum class End { Finished, Diverged, Stopped, TooLarge };  // too large for the method
  End end = End::Finished;
  std::vector<State> snapshots;  // those that were reached
  double cpu_seconds = 0.0;      // of stepping alone; real time on a device
  WorkCounts work;
  long unconverged_solves = 0;
  double model_ms = 0.0;  // [ms], of `auto`: its cost by the model, with that of its choices
};

class Benchmark {
 public:
  explicit Benchmark(const Problem& problem);  // `problem` must outlive it

  // Runs a method. `should_continue` is called a few hundred times between two snapshots, of an adaptive method after every few steps.
  RunResult run(const Integrator& method, const Setting& setting, const std::function<bool()>& should_continue);
  // The same from another initial state.
  RunResult run(const Integrator& method, const Setting& setting, const State& start, const std::function<bool()>& should_continue);

  // Computes the frames that it does not refuse from now on; null: the processor computes all.
  void set_device(std::shared_ptr<FrameDevice> device) { plan_.execution.device = std::move(device); }
  // [s], CPU time of this thread, or with a device real time.
  double now() const;

  const Problem& problem() const { return problem_; }
  const Plan& plan() const { return plan_; }
  const Spectrum& spectrum() const { return plan_.spectrum; }
  double resolving_step() const { return plan_.resolving_step(); }  // [s], of colliders and muscles (plan.h)
  // [s]; for an adaptive method the longest step it may take.
  double step(const Setting& setting) const { return problem_.seconds / snapshot_count / frames_ / setting.steps; }
  // Half the step; a tenth of the tolerance.
  Setting finer(const Setting& setting) const;
  // "64 steps/s", "tolerance 1e-06".
  std::string name(const Setting& setting) const;

 private:
  const Problem& problem_;
  const int frames_;  // between two snapshots
  Plan plan_;
  FrameRunner frame_;  // reused, so that data built once per topology is not counted as stepping
};

// RMS over the points of the distance between two states [m].
double rms_distance(const System& system, const State& first, const State& second);

}  // namespace hooke
