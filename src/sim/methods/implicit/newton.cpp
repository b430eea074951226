// V minimizes, without dashpots, the incremental potential     (e.g. T. F. Gast, C. Schroeder, Optimization Integrator for
// Large Time Steps, SCA 2014)
//   Phi(V) = 1/2 (V - v) M (V - v) + b c / 2 V M V + E(x + b V),     grad Phi = M (V - v) - b f(x + b V, V),
// E the springs' energy, gravity's and the pull's. Dashpots add b/2 sum d (u.(V1 - V2))^2 with the directions u of the
// iterate, and the listed forces (force_term.h) -f.x with their value there, so that the gradient is right although there is
// no potential for all iterates. Every step p = -A^-1 grad Phi with A positive definite leads downhill, and a line search
// makes sure that it arrives there. A contains the derivatives of the listed forces as far as they are positive semidefinite
// (force_tangent.h). Forces that are not continuous are frozen after some iterations.
//
// Economy: a factorization is reused for later stages and steps of the frame, until its steps contract by less than a factor of
// four or one is too long. Curvature: exact where the masses dominate, clamped (stiffness.h) where they do not, and wherever the
// exact matrix is not positive definite; near the solution exact again, for speed.
#include "sim/methods/implicit/newton.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"
#include "sim/forces/spring_laws.h"
#include "sim/methods/constants.h"
#include "sim/plan/phase_times.h"

namespace hooke {
namespace {

// x + b V
void set_positions(const Stage& stage, const Field& V, Field& x) {
  std::copy(stage.x.begin(), stage.x.end(), x.begin());
  add_scaled(x.data(), stage.b, V.data(), x.size());
}

// V of the points that do not move freely, zero for the others.
void set_to_rest(const Plan& plan, const Field& V, Field& result) {
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i) {
      const std::size_t at = static_cast<std::size_t>(c) * plan.points + i;
      result[at] = plan.inverse_mass[i] == 0.0 ? V[at] : 0.0;
    }
}

}  // namespace

void NewtonSolver::begin_frame(const Plan& plan, const Motion& motion) {
  free_points_ = static_cast<Index>(std::count_if(plan.inverse_mass.begin(), plan.inverse_mass.end(), [](double w) { return w != 0.0; }));
  if (free_points_ == 0) return;
  if (!matrix_) matrix_.emplace(plan);
  matrix_->allocate(plan);
  factored_b_ = 0.0;  // a frame depends only on its State, not on the matrix of the previous frame
  for (Field* field : {&x_, &f_, &term_force_, &residual_, &step_, &trial_x_, &trial_v_}) field->resize(motion.x.size());

  max_coordinate_ = 0.0;
  for (const double length : plan.spring.rest_length) max_coordinate_ = std::max(max_coordinate_, length);
  for (const double x : motion.x) max_coordinate_ = std::max(max_coordinate_, std::abs(x));
}

NewtonSolver::Potential NewtonSolver::potential(const Plan& plan, const Stage& stage, const Field& x, const Field& V) const {
  Potential sum;
  const auto add = [&](double term) {
    sum.value += term;
    sum.magnitude += std::abs(term);
  };
  const std::size_t n = plan.points;

  // inertia, drag, gravity
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0; i < n; ++i) {
      if (plan.inverse_mass[i] == 0.0) continue;
      const std::size_t at = c * n + i;
      const double velocity_change = V[at] - stage.v[at];
      add(0.5 * plan.mass[i] * (velocity_change * velocity_change + stage.b * plan.drag * V[at] * V[at]));
      add(-plan.mass[i] * plan.acceleration[c] * x[at]);
    }

  if (!plan.forces.empty())
    for (std::size_t at = 0; at < x.size(); ++at) add(-term_force_[at] * (x[at] - x_[at]));

  // springs; dashpots along the directions at x_
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    add(response_of(plan, s, stage.time, glm::length(difference_at(plan, x, i, j))).of.energy);
    if (!plan.has_dashpots()) return;
    const Vec3 direction = difference_at(plan, x_, i, j);
    const double length = glm::length(direction);
    if (length == 0.0) return;
    const double speed = glm::dot(direction, difference_at(plan, V, i, j)) / length;
    add(0.5 * stage.b * response_of(plan, s, stage.time, length).damping * speed * speed);
  });

  if (plan.hand.pull) {
    const Vec3 stretch = pull_stretch(plan, x, stage.time);
    add(0.5 * plan.hand.pull->stiffness * glm::dot(stretch, stretch));
  }
  return sum;
}

// x_ = x + b V and residual_ = grad Phi there, with listed forces at their own velocities or unchanged.
void NewtonSolver::evaluate(const Plan& plan, const Stage& stage, const Field& V, const Field* term_velocity, Motion& motion) {
  set_positions(stage, V, x_);
  compute_unlisted_forces(plan, stage.time, x_, plan.has_dashpots() ? &V : nullptr, f_);
  ++motion.counts.force_evaluations;

  if (!plan.forces.empty()) {
    if (term_velocity != nullptr) {
      std::copy(f_.begin(), f_.end(), term_force_.begin());
      add_force_terms(plan, stage.time, x_, *term_velocity, term_force_);
      add_scaled(term_force_.data(), -1.0, f_.data(), f_.size());
    }
    add_scaled(f_.data(), 1.0, term_force_.data(), f_.size());
  }

  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i) {
      const std::size_t at = static_cast<std::size_t>(c) * plan.points + i;
      const double inertia = plan.mass[i] * (V[at] - stage.v[at] + stage.b * plan.drag * V[at]);
      residual_[at] = plan.inverse_mass[i] == 0.0 ? 0.0 : inertia - stage.b * f_[at];
    }
}

void NewtonSolver::factorize(const Plan& plan, const Stage& stage, Curvature curvature, const Field& V, const Field& term_velocity,
                             Motion& motion) {
  const InPhase in(plan.execution.phases, Phase::Solve);
  matrix_->linearize_forces(plan, stage.time, x_, term_velocity);
  matrix_->assemble(plan, stage.b, x_, V, curvature);
  ++motion.counts.factorizations;
  if (!matrix_->factorize() && curvature == Curvature::Exact) {
    matrix_->assemble(plan, stage.b, x_, V, Curvature::Clamped);
    ++motion.counts.factorizations;
    matrix_->factorize();
  }
  factored_b_ = stage.b;
}

// step_ = -A^-1 grad Phi
void NewtonSolver::compute_step(const Plan& plan, Motion& motion) {
  const InPhase in(plan.execution.phases, Phase::Solve);
  set_scaled(step_.data(), -1.0, residual_.data(), step_.size());
  matrix_->solve(step_);
  clear_fixed_axes(plan, step_.data());
  ++motion.counts.solves;
}

// Halves the step until Phi decreases as required by Armijo's rule; a decrease below the rounding error of Phi is accepted. The
// result is in trial_v_. Returns the fraction of the step, 0 if none leads downhill.
double NewtonSolver::line_search(const Plan& plan, const Stage& stage, const Field& V, const Potential& current, Potential& trial) {
  const double slope = dot(residual_, step_);
  for (double step_fraction = 1.0; step_fraction > min_newton_step; step_fraction *= 0.5) {
    std::copy(V.begin(), V.end(), trial_v_.begin());
    add_scaled(trial_v_.data(), step_fraction, step_.data(), V.size());
    set_positions(stage, trial_v_, trial_x_);
    trial = potential(plan, stage, trial_x_, trial_v_);
    if (trial.value <= current.value + armijo * step_fraction * slope || -step_fraction * slope <= potential_round_off * current.magnitude)
      return step_fraction;
  }
  return 0.0;
}

// Restarts from rest if Phi is lower there than after the first step: in a scene far from its rest lengths the guess may be
// useless. Phi at rest bounds the result: no more elastic energy than there was energy before.
void NewtonSolver::restart_from_rest_if_lower(const Plan& plan, const Stage& stage, Field& V, Potential& current) {
  set_to_rest(plan, V, trial_v_);
  set_positions(stage, trial_v_, trial_x_);
  const Potential at_rest = potential(plan, stage, trial_x_, trial_v_);
  if (at_rest.value >= current.value) return;
  std::swap(V, trial_v_);
  current = at_rest;
}

// [m/s]: rounding of positions changes a spring force by k epsilon x, and V by at most b k / m of that, or by 1 / b where stiffness
// dominates.
double NewtonSolver::round_off(const Plan& plan, const Stage& stage, const Field& V) const {
  const double stiffness = stage.b * plan.spectrum.omega * (stage.b * plan.spectrum.omega);
  return position_round_off * (root_mean_square(plan, V) + max_coordinate_ / stage.b * stiffness / (1.0 + stiffness));
}

// RMS of V - v [m/s].
double NewtonSolver::velocity_change(const Plan& plan, const Stage& stage, const Field& V) {
  for (std::size_t i = 0; i < V.size(); ++i) trial_v_[i] = V[i] - stage.v[i];
  return root_mean_square(plan, trial_v_);
}

void NewtonSolver::solve(const Plan& plan, const Stage& stage, const NewtonLimits& limits, Field& V, Motion& motion) {
  if (free_points_ == 0) return;
  const long max_factorizations = motion.counts.factorizations + limits.factorizations;
  Curvature curvature = stage.b * plan.spectrum.omega > max_exact_stiffness ? Curvature::Clamped : Curvature::Exact;
  bool matrix_is_stale = factored_b_ != stage.b;
  double previous_size = 0.0;  // of the last step, if it was taken whole
  const bool can_freeze = std::ranges::any_of(plan.forces, [](const Force& force) { return !force.term->is_continuous; });

  evaluate(plan, stage, V, &V, motion);
  Potential current = potential(plan, stage, x_, V), trial;
  for (int iteration = 0; iteration < limits.iterations; ++iteration) {
    if (matrix_is_stale && motion.counts.factorizations < max_factorizations) factorize(plan, stage, curvature, V, V, motion);
    compute_step(plan, motion);

    // remaining error after this step, from the contraction of the steps; where they no longer contract, it is round-off
    const double size = root_mean_square(plan, step_), round_off_level = round_off(plan, stage, V);
    const double contraction = previous_size > 0.0 ? size / previous_size : 1.0;
    const double remaining_error = contraction < 0.5 ? size * contraction / (1.0 - contraction) : size;
    if (remaining_error <= std::max(round_off_level, limits.tolerance * velocity_change(plan, stage, V)) ||
        (contraction > max_contraction && size < 1000.0 * round_off_level)) {
      add_scaled(V.data(), 1.0, step_.data(), V.size());
      return;
    }

    const double step_fraction = line_search(plan, stage, V, current, trial);
    if (step_fraction == 0.0) break;
    std::swap(V, trial_v_);
    if (iteration == 0) restart_from_rest_if_lower(plan, stage, V, trial);

    // a step too long for the matrix requires clamped curvature, full steps that contract too little require the exact one
    matrix_is_stale = step_fraction < 1.0 || (previous_size > 0.0 && contraction > max_contraction);
    curvature = step_fraction < 1.0 ? Curvature::Clamped : Curvature::Exact;
    previous_size = step_fraction < 1.0 ? 0.0 : size;
    evaluate(plan, stage, V, !can_freeze || iteration < max_force_updates ? &V : nullptr, motion);
    current = plan.has_dashpots() || !plan.forces.empty() ? potential(plan, stage, x_, V) : trial;
  }
  ++motion.counts.unconverged_solves;
}

void NewtonSolver::solve_once(const Plan& plan, const Stage& stage, Field& V, Motion& motion) {
  if (free_points_ == 0) return;
  set_to_rest(plan, V, V);
  evaluate(plan, stage, V, &stage.v, motion);
  factorize(plan, stage, Curvature::Clamped, V, stage.v, motion);
  // f(x, V) = f(x, v) - D (V - v) of the listed forces
  matrix_->add_force_damping(plan, -stage.b, stage.v, residual_);
  compute_step(plan, motion);
  add_scaled(V.data(), 1.0, step_.data(), V.size());
}

}  // namespace hooke
