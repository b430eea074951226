// The converged solution of a problem, and how far it can be trusted.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/benchmark.h"

namespace hooke {

// How far a run is from the reference.
struct Score {
  double error = 0.0;                    // [m], the worst snapshot: RMS over the points of the distance, or of the centre of mass
  double relative_error = 0.0;           // [1], error over the problem's size; for observables the worst of the three
  double energy_drift = 0.0;             // [1], worst energy beyond the reference's, over its greatest kinetic energy
  std::optional<double> strain_error{};  // [1], of the largest strain, where observables are judged
};

// One method, refined until it changes no more.
struct Refinement {
  const Integrator* method = nullptr;
  Setting setting;  // of the finest run
  std::string setting_name;
  double gap = 0.0;              // [1], relative error of the run before against it (half the steps, ten times the tolerance)
  std::vector<State> snapshots;  // of the finest run
  std::vector<State> coarser;    // of the run before
};

struct Reference {
  Refinement own, other;       // the reference itself, and another method's
  double other_gap = 0.0;      // [1], relative error of the other against it
  double amplification = 0.0;  // [1], by how much a perturbation of 1e-10 of the size has grown, at most, at a snapshot
  Measure measure = Measure::Trajectory;

  const std::vector<State>& snapshots() const { return own.snapshots; }
  // Relative errors below this are the reference's own.
  double uncertainty() const { return own.gap > other_gap ? own.gap : other_gap; }
};

Score judge(const Problem& problem, Measure measure, const std::vector<State>& reference, const std::vector<State>& measured);

// The methods of highest order on this problem, best first, those with a limit on their step before those that solve
// equations: the first makes the reference, the second checks it.
std::vector<const Integrator*> most_accurate_methods(const Problem& problem);

// Refines two methods, each for about `seconds` of CPU time at most, and perturbs the start. A trajectory that the two
// do not agree on to a thousandth is judged by observables. None when `should_continue` said no.
std::optional<Reference> compute_reference(Benchmark& benchmark, double seconds, const std::function<bool()>& should_continue);

}  // namespace hooke
