// The converged solution of a problem, and how far two different methods agree on it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/benchmark.h"

namespace hooke {

// The distance of a run from the reference.
struct Score {
  double error = 0.0;                    // [m], the worst snapshot: RMS distance of the points, or distance of the centers of mass
  double relative_error = 0.0;           // [1], error relative to the size of the problem; for observables the worst of the three
  double energy_drift = 0.0;             // [1], maximum energy above that of the reference, relative to its maximum kinetic energy
  std::optional<double> strain_error{};  // [1], of the largest strain, if observables are compared
};

// One method, refined until its solution no longer changes.
struct Refinement {
  const Integrator* method = nullptr;
  Setting setting;  // of the finest run
  std::string setting_name;
  double gap = 0.0;              // [1], relative error of the previous, coarser run against it
  std::vector<State> snapshots;  // of the finest run
  std::vector<State> coarser;    // of the previous run
};

struct Reference {
  Refinement own, other;       // the reference itself, and the check by another method
  double other_gap = 0.0;      // [1], relative error of the other against it
  double amplification = 0.0;  // [1], largest growth of a perturbation of 1e-10 of the size, over the snapshots
  Measure measure = Measure::Trajectory;

  const std::vector<State>& snapshots() const { return own.snapshots; }
  // Relative errors below this cannot be distinguished from the error of the reference.
  double uncertainty() const { return own.gap > other_gap ? own.gap : other_gap; }
};

Score judge(const Problem& problem, Measure measure, const std::vector<State>& reference, const std::vector<State>& measured);

// The methods of highest order on this problem, best first, explicit before implicit ones: the first computes the reference, the second
// checks it.
std::vector<const Integrator*> most_accurate_methods(const Problem& problem);

// Gaps between the two methods, and between the last two refinements of each, up to which a solution is accepted [1]: for the positions of
// all points, or else for the observables.
inline constexpr double max_trajectory_gap = 1e-3, max_observables_gap = 1e-2;

struct ReferenceResult {
  enum class Failure { None, Interrupted, NotFinished, Disagreement };
  std::optional<Reference> reference;  // none in case of failure
  Failure failure = Failure::None;
  std::string reason;  // of the failure, in one line
};

// Refines two methods, each for about `seconds` of CPU time at most, and perturbs the initial state. A method that reaches no result in
// that time is replaced by the next. If the two do not agree on the trajectory they must agree on the observables; otherwise there is no
// reference.
ReferenceResult compute_reference(Benchmark& benchmark, double seconds, const std::function<bool()>& should_continue);

}  // namespace hooke
