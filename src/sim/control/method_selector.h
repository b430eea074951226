// Which method `auto` uses: the cheapest of those that meet the tolerance in the coming frame, which each computes on a copy.
#pragma once

#include <vector>

#include "sim/control/error_estimator.h"
#include "sim/methods/step_limits.h"
#include "sim/step/step.h"

namespace hooke {

// A frame computed with `substeps`, and before with half as many, to estimate its error.
struct FrameTrial {
  const Integrator* method = nullptr;  // null: none could be tried
  int substeps = 2;
  double error = 0.0;  // [m]
  double cost = 0.0;   // [ms], of all runs, by the model
};

class MethodSelector {
 public:
  // Compares the methods with fixed steps in the table on the frame that follows `state`. `share` [m]: the error allowed to a frame;
  // `max_cost` [ms]: of a frame, and of the comparison. If none meets the share, the one that comes closest to it.
  FrameTrial select(const Plan& plan, const System& system, const Settings& settings, const State& state, const StepLimits& limits,
                    double share, double max_cost);
  // [ms], of all comparisons so far, by the model.
  double total_cost() const { return total_cost_; }

 private:
  struct Scene {
    const System& system;
    const Settings& settings;
    const State& state;
    const StepLimits& limits;
    double share;
  };
  // A method and the substeps of its next attempt.
  struct Candidate {
    const Integrator* method;
    int substeps;
    double cost;  // [ms], expected
    int attempts = 0;
  };
  std::vector<Candidate> candidates_for(const StepLimits& limits, double frame_rate) const;
  double compute(const Scene& scene, const Integrator& method, int substeps, double max_cost, FrameEnd& end);
  FrameTrial attempt(const Scene& scene, const Integrator& method, int substeps, double max_cost);
  bool keeps_vibrations(const Scene& scene, const FrameTrial& trial, double max_cost);

  Plan plan_;
  Frame frame_;
  State scratch_;
  FrameRuns runs_;  // of the last trial
  FrameEnd with_all_;
  double total_cost_ = 0.0;
};

// Sets where the frame ended that followed `start`. `scratch`: memory that is used again.
void set_end(FrameEnd& end, const Frame& frame, const Plan& plan, const State& start, State& scratch);

// The substeps of the first run of a frame whose last one takes so many.
int first_substeps(const Integrator& method, int substeps);

// The fewest substeps with which `auto` uses the method: stable ones that resolve what moves, and dashpots where the method splits them
// off; none: it does not.
std::optional<int> min_automatic_substeps(const StepLimits& limits, const Integrator& method, double frame_rate);

}  // namespace hooke
