// Newton's method for the stages of implicit methods: the one kernel they all share.
#pragma once

#include <optional>

#include "sim/implicit/stiffness.h"
#include "sim/motion.h"

namespace hooke {

// A stage asks for the velocities V with M (V - v) = b f(t, X, V), X = x + b V.
struct Stage {
  double time;     // [s]
  double b;        // [s], the share of the step that is implicit
  const Field& x;  // [m], what the positions are without V
  const Field& v;  // [m/s], what the velocities are without the stage's own acceleration
};

// How far a solve goes.
struct NewtonLimits {
  double tolerance = 1e-12;  // [1], error in V allowed, of V - v; never less than round-off
  int iterations = 100;
  int factorizations = 20;  // more or less: then it goes on with the last matrix
};

class NewtonSolver : public Structure {
 public:
  explicit NewtonSolver(const Plan& plan) : Structure(plan) {}

  // Once a frame, before its first solve.
  void begin_frame(const Plan& plan, const Motion& motion);

  // V starts as a guess and ends as the solution; points that do not move freely keep theirs. Converged or not, without
  // dashpots the result has no more of the incremental potential (newton.cpp) than the guess, or than rest. Counts its work
  // in `motion`.
  void solve(const Plan& plan, const Stage& stage, const NewtonLimits& limits, Field& V, Motion& motion);

  // One iteration from rest with clamped curvature: what is linear about the positions without V.
  void solve_once(const Plan& plan, const Stage& stage, Field& V, Motion& motion);

 private:
  struct Potential {
    double value = 0.0, magnitude = 0.0;  // [J], and the sum of the sizes of its terms
  };
  Potential potential(const Plan& plan, const Stage& stage, const Field& x, const Field& V) const;
  void evaluate(const Plan& plan, const Stage& stage, const Field& V, const Field* term_velocity, Motion& motion);
  void factorize(const Plan& plan, const Stage& stage, Curvature curvature, const Field& V, Motion& motion);
  void compute_step(Motion& motion);
  double line_search(const Plan& plan, const Stage& stage, const Field& V, const Potential& current, Potential& trial);
  void restart_from_rest_if_lower(const Plan& plan, const Stage& stage, Field& V, Potential& current);
  double round_off(const Plan& plan, const Stage& stage, const Field& V) const;
  double velocity_change(const Plan& plan, const Stage& stage, const Field& V);

  std::optional<StiffnessMatrix> matrix_;  // absent while nothing can move
  Index free_points_ = 0;                  // points
  double max_coordinate_ = 0.0;            // [m], of the coordinates
  double factored_b_ = 0.0;                // [s], of the matrix now factored; 0: none of this frame
  Field x_, f_, term_force_, residual_, step_, trial_x_, trial_v_;
};

}  // namespace hooke
