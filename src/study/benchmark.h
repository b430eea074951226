// A problem as a course that methods are sent over: from the start through four snapshots, at one setting, with the CPU
// time and the work counted.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/integrator.h"
#include "sim/plan.h"
#include "sim/step.h"
#include "study/problem.h"

namespace hooke {

// Snapshots are taken at the end of each of so many equal parts of a problem's duration.
inline constexpr int snapshot_count = 4;

// Whether the method chooses its steps itself, within a tolerance, instead of taking the one given.
bool is_adaptive(const Integrator& method);

// Steps between two snapshots, or the tolerance [m] of an adaptive method.
struct Setting {
  int steps = 1;
  std::optional<double> tolerance;
  bool operator==(const Setting&) const = default;
};

// What a run has cost besides time.
struct WorkCounts {
  long force_evaluations = 0, factorizations = 0, solves = 0, sweeps = 0;
  bool operator==(const WorkCounts&) const = default;
};

struct RunResult {
  enum class End { Finished, Diverged, Stopped };
  End end = End::Finished;
  std::vector<State> snapshots;  // as many as were reached
  double cpu_seconds = 0.0;      // of the steps alone
  WorkCounts work;
  long unconverged_solves = 0;
};

class Benchmark {
 public:
  explicit Benchmark(const Problem& problem);  // which must outlive it

  // Sends a method over the course. `should_continue` is asked some hundred times between two snapshots at most.
  RunResult run(const Integrator& method, const Setting& setting, const std::function<bool()>& should_continue);
  // The same from another start.
  RunResult run(const Integrator& method, const Setting& setting, const State& start, const std::function<bool()>& should_continue);

  const Problem& problem() const { return problem_; }
  const Spectrum& spectrum() const { return plan_.spectrum; }
  // [s]; of a method that chooses its steps, the longest it may take.
  double step(const Setting& setting) const { return problem_.seconds / snapshot_count / setting.steps; }
  // "64 steps/s", "tolerance 1e-06".
  std::string name(const Setting& setting) const;

 private:
  const Problem& problem_;
  Plan plan_;
  Frame frame_;  // kept, so that what a method builds once for a topology is not counted as stepping
};

// RMS over the points of the distance between two states [m].
double rms_distance(const State& first, const State& second);

// CPU time that this process has used [s].
double cpu_seconds();

}  // namespace hooke
