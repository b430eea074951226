// Derivatives carried backwards through one step of a method.
#pragma once

#include <vector>

#include "sim/forces/motion.h"
#include "sim/methods/integrator.h"

namespace hooke {

// Derivatives of the weighted sum by the state before the steps that have been passed backwards, and by what those steps used.
struct Adjoint {
  explicit Adjoint(const Plan& plan)
      : x(static_cast<std::size_t>(plan.points) * plan.dimensions),
        v(x.size()),
        stiffness(plan.spring.stiffness.size()),
        rest_length(stiffness.size()),
        damping(stiffness.size()),
        decay(stiffness.size()),
        inverse_mass(static_cast<std::size_t>(plan.points)) {}
  Field x, v;
  // of the packed springs; `decay`: of what a sweep over the dashpots takes (plan_dashpot_decay)
  std::vector<double> stiffness, rest_length, damping, decay;
  std::vector<double> inverse_mass;  // of the points
};

// A spring and its points.
struct Link {
  Index first, second, spring;
};

class StepAdjoint {
 public:
  // Null: the method has none.
  using Back = void (StepAdjoint::*)(const Field& x, const Field& v, const Field& next_x, Adjoint& to);
  static Back find(const Integrator& method);

  // For steps of h [s].
  StepAdjoint(const Plan& plan, const Integrator& method, double h);
  // Backwards from the state after the step to that before it, (x, v).
  void pass(const Field& x, const Field& v, const Field& next_x, Adjoint& to) { (this->*back_)(x, v, next_x, to); }
  // After all steps: the derivatives by `decay` become those by damping and masses.
  void finish(Adjoint& to) const;

 private:
  void pass_verlet(const Field& x, const Field& v, const Field& next_x, Adjoint& to);
  void pass_runge_kutta4(const Field& x, const Field& v, const Field& next_x, Adjoint& to);
  void pass_acceleration(const Field& x, const Field* v, const Field& of_a, Adjoint& to, Field& to_x, Field* to_v) const;
  void sweep(SweepDirection direction, const Field& x, Field& v, std::vector<Vec3>& before) const;
  void pass_sweep(SweepDirection direction, const Field& x, const std::vector<Vec3>& before, Adjoint& to) const;

  const Plan& plan_;
  Back back_;
  double h_;
  std::vector<Link> links_, reversed_;  // in the order of a forward sweep over the dashpots, and of a backward one
  std::vector<double> decay_;           // of half a step
  std::vector<Vec3> first_, last_;      // [m/s], what the two sweeps of a step meet
  std::vector<Field> fields_;
};

}  // namespace hooke
