// Small problems of the benchmark, and the record of every method on one of them.
#pragma once

#include <utility>

#include "sim/step/divergence.h"
#include "study/analytic_scenes.h"
#include "study/work_precision.h"
#include "support/sanitizer_slowdown.h"

namespace hooke {

inline bool always() { return true; }

inline Problem problem_of(InitialState start, double seconds) {
  initialize_supply(start.system, start.state);
  return {.id = "problem", .title = "a problem", .system = std::move(start.system), .start = std::move(start.state), .seconds = seconds};
}

// Net W2 with fewer points, starting in full motion: from its own start, in equilibrium, a first-order method whose velocities are half a
// step late is as accurate as one of second order.
inline Problem net_in_motion(double seconds) {
  Problem problem = problem_of(make_net(6, 1e2, 0.0), 0.4);
  Benchmark benchmark(problem);
  problem.start = benchmark.run(*find_integrator("dop853"), {.tolerance = 1e-13}, always).snapshots.back();
  problem.start.time = 0.0;
  problem.start.memory = {};
  initialize_supply(problem.system, problem.start);
  problem.seconds = seconds;
  return problem;
}

inline Effort small_effort() {
  return {.repeats = 1, .run_seconds = 0.1 * sanitizer_slowdown, .reference_seconds = 2.0, .finest_error = 1e-9};
}

// The record of every method on a small net, computed once.
inline const Problem& swept_problem() {
  static const Problem problem = net_in_motion(2.0);
  return problem;
}

inline const ProblemRecord& swept_record() {
  static const ProblemRecord record = [] {
    ProblemRecord made = make_record(swept_problem());
    const Effort effort = small_effort();
    PrecisionSweep sweep(swept_problem(), effort, made);
    for (const Integrator& method : integrators()) sweep.run(method);
    return made;
  }();
  return record;
}

}  // namespace hooke
