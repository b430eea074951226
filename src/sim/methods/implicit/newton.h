// Newton's method for the stages of implicit methods, common to all of them.
#pragma once

#include <optional>

#include "sim/forces/motion.h"
#include "sim/methods/constants.h"
#include "sim/methods/implicit/stiffness.h"

namespace hooke {

// A stage: find the velocities V with M (V - v) = b f(t, X, V), X = x + b V.
struct Stage {
  double time;     // [s]
  double b;        // [s], the implicit part of the step
  const Field& x;  // [m], positions without the contribution of V
  const Field& v;  // [m/s], velocities without the acceleration of the stage
};

// Termination of a solve.
struct NewtonLimits {
  double tolerance = 1e-12;  // [1], error of V relative to V - v; round-off is always accepted
  int iterations = max_newton_iterations;
  int factorizations = max_newton_factorizations;
};

class NewtonSolver : public Structure {
 public:
  explicit NewtonSolver(const Plan& plan) : Structure(plan) {}

  // Once per frame, before its first solve.
  void begin_frame(const Plan& plan, const Motion& motion);

  // V is the initial guess, and the solution on return; points that are not free keep theirs. Converged or not, without
  // dashpots the incremental potential (newton.cpp) of the result is at most that of the guess and of rest. Counts its cost
  // in `motion`.
  void solve(const Plan& plan, const Stage& stage, const NewtonLimits& limits, Field& V, Motion& motion);

  // One iteration from rest with clamped curvature: the problem linearized about the positions without V.
  void solve_once(const Plan& plan, const Stage& stage, Field& V, Motion& motion);

 private:
  struct Potential {
    double value = 0.0, magnitude = 0.0;  // [J], and the sum of the magnitudes of its terms
  };
  Potential potential(const Plan& plan, const Stage& stage, const Field& x, const Field& V) const;
  void evaluate(const Plan& plan, const Stage& stage, const Field& V, const Field* term_velocity, Motion& motion);
  void factorize(const Plan& plan, const Stage& stage, Curvature curvature, const Field& V, const Field& term_velocity, Motion& motion);
  void compute_step(const Plan& plan, Motion& motion);
  double line_search(const Plan& plan, const Stage& stage, const Field& V, const Potential& current, Potential& trial);
  void restart_from_rest_if_lower(const Plan& plan, const Stage& stage, Field& V, Potential& current);
  double round_off(const Plan& plan, const Stage& stage, const Field& V) const;
  double velocity_change(const Plan& plan, const Stage& stage, const Field& V);

  std::optional<StiffnessMatrix> matrix_;  // absent without free points
  Index free_points_ = 0;                  // points
  double max_coordinate_ = 0.0;            // [m], of the coordinates
  double factored_b_ = 0.0;                // [s], of the current factorization; 0: none in this frame
  Field x_, f_, term_force_, residual_, step_, trial_x_, trial_v_;
};

}  // namespace hooke
