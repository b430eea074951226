// V minimises, without dashpots, the incremental potential     (e.g. T. F. Gast, C. Schroeder, Optimization Integrator for
// Large Time Steps, SCA 2014)
//   Phi(V) = 1/2 (V - v) M (V - v) + b c / 2 V M V + E(x + b V),     grad Phi = M (V - v) - b f(x + b V, V),
// E the springs' energy, gravity's and the pull's. Dashpots add b/2 sum d (u.(V1 - V2))^2 with the directions u of the
// iterate, so that the gradient is right there, although there is no potential for all iterates. Every step p = -A^-1 grad Phi
// with A positive definite leads downhill, and a line search makes sure that it arrives there.
//
// Economy: a factored matrix serves on, for later stages and steps of the frame too, until its steps contract by less than
// a quarter or one is too long. Curvature: exact where the masses dominate, clamped (stiffness.h) where they do not, and
// where an exact matrix turns out not to be positive definite; near the solution exact again, for speed.
#include "sim/newton.h"

#include <algorithm>
#include <cmath>

#include "sim/field_kernel.h"
#include "sim/forces.h"

namespace hooke {
namespace {

// Contraction beyond which a new factor is cheaper than more iterations.
constexpr double slow = 0.25;
// b omega beyond which exact curvature is not tried far from the solution.
constexpr double stiff = 10.0;

// x + b V
void set_positions(const Stage& stage, const Field& V, Field& x) {
  std::copy(stage.x.begin(), stage.x.end(), x.begin());
  add_scaled(x.data(), stage.b, V.data(), x.size());
}

// V, but zero for the points that move freely.
void rest(const Plan& plan, const Field& V, Field& result) {
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i) {
      const std::size_t at = static_cast<std::size_t>(c) * plan.points + i;
      result[at] = plan.inverse_mass[i] == 0.0 ? V[at] : 0.0;
    }
}

double dot(const Field& a, const Field& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void NewtonKernel::begin_frame(const Plan& plan, const Motion& motion) {
  moving_ = static_cast<Index>(std::count_if(plan.inverse_mass.begin(), plan.inverse_mass.end(), [](double w) { return w != 0.0; }));
  if (moving_ == 0) return;
  if (!matrix_) matrix_.emplace(plan);
  factored_b_ = 0.0;
  for (Field* field : {&x_, &f_, &residual_, &step_, &trial_x_, &trial_v_}) field->resize(motion.x.size());

  extent_ = 0.0;
  for (const double length : plan.rest_length) extent_ = std::max(extent_, length);
  for (int c = 0; c < plan.dimensions; ++c) {
    const auto begin = motion.x.begin() + static_cast<std::ptrdiff_t>(c) * plan.points;
    const auto [least, most] = std::minmax_element(begin, begin + plan.points);
    extent_ = std::max(extent_, *most - *least);
  }
  if (!(extent_ > 0.0)) extent_ = 1.0;
}

NewtonKernel::Potential NewtonKernel::potential(const Plan& plan, const Stage& stage, const Field& x, const Field& V) const {
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
      const double change = V[at] - stage.v[at];
      add(0.5 * plan.mass[i] * (change * change + stage.b * plan.drag * V[at] * V[at]));
      add(-plan.mass[i] * plan.acceleration[c] * x[at]);
    }

  // springs; dashpots along the directions at x_
  for (const SpringRun& run : plan.runs)
    for (Index e = 0; e < run.count; ++e) {
      const std::size_t i = run.first + e, j = run.second + e;
      const Index s = run.begin + e;
      double length_squared = 0.0, along = 0.0, direction_squared = 0.0;
      for (int c = 0; c < plan.dimensions; ++c) {
        const double apart = x[c * n + i] - x[c * n + j];
        length_squared += apart * apart;
        if (!plan.has_dashpots()) continue;
        const double direction = x_[c * n + i] - x_[c * n + j];
        direction_squared += direction * direction;
        along += direction * (V[c * n + i] - V[c * n + j]);
      }
      const double stretch = std::sqrt(length_squared) - plan.rest_length[s];
      add(0.5 * plan.stiffness[s] * stretch * stretch);
      if (plan.has_dashpots() && direction_squared > 0.0) add(0.5 * stage.b * plan.damping[s] * along * along / direction_squared);
    }

  if (plan.pull) {
    const Vec3 target = plan.pull->target_at(stage.time);
    for (int c = 0; c < plan.dimensions; ++c) {
      const double reach = x[c * n + plan.pull->point] - target[c];
      add(0.5 * plan.pull->stiffness * reach * reach);
    }
  }
  return sum;
}

// x_ = x + b V and residual_ = grad Phi there.
void NewtonKernel::compute_residual(const Plan& plan, const Stage& stage, const Field& V, Motion& motion) {
  set_positions(stage, V, x_);
  compute_forces(plan, stage.time, x_, V, f_);
  ++motion.force_evaluations;
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i) {
      const std::size_t at = static_cast<std::size_t>(c) * plan.points + i;
      residual_[at] = plan.inverse_mass[i] == 0.0 ? 0.0 : plan.mass[i] * (V[at] - stage.v[at]) - stage.b * f_[at];
    }
}

void NewtonKernel::factorize(const Plan& plan, const Stage& stage, Curvature curvature, const Field& V, Motion& motion) {
  matrix_->assemble(plan, stage.b, x_, V, curvature);
  ++motion.factorizations;
  if (!matrix_->solver().factorize() && curvature == Curvature::Exact) {
    matrix_->assemble(plan, stage.b, x_, V, Curvature::Clamped);
    ++motion.factorizations;
    matrix_->solver().factorize();
  }
  factored_b_ = stage.b;
}

// step_ = -A^-1 grad Phi
void NewtonKernel::compute_step(const Plan&, Motion& motion) {
  set_scaled(step_.data(), -1.0, residual_.data(), step_.size());
  matrix_->solver().solve(step_);
  ++motion.solves;
}

void NewtonKernel::go_to_rest_if_lower(const Plan& plan, const Stage& stage, Field& V, Potential& here) {
  rest(plan, V, trial_v_);
  set_positions(stage, trial_v_, x_);
  const Potential at_rest = potential(plan, stage, x_, trial_v_);
  if (at_rest.value >= here.value) return;
  std::swap(V, trial_v_);
  here = at_rest;
}

void NewtonKernel::solve_once(const Plan& plan, const Stage& stage, Field& V, Motion& motion) {
  if (moving_ == 0) return;
  rest(plan, V, V);
  compute_residual(plan, stage, V, motion);
  factorize(plan, stage, Curvature::Clamped, V, motion);
  compute_step(plan, motion);
  add_scaled(V.data(), 1.0, step_.data(), V.size());
}

// [m/s], RMS over the points. Rounding of positions moves a spring's force by k epsilon x, and V by what the matrix makes
// of that: b k / m of it at most, and 1 / b where stiffness dominates.
double NewtonKernel::allowed_error(const Plan& plan, const Stage& stage, double tolerance, const Field& V) {
  constexpr double epsilon = 4e-16;
  const double stiffness = std::pow(stage.b * plan.spectrum.omega, 2);
  const double round_off = epsilon * (root_mean_square(plan, V) + extent_ / stage.b * stiffness / (1.0 + stiffness));
  for (std::size_t i = 0; i < V.size(); ++i) trial_v_[i] = V[i] - stage.v[i];
  return std::max(tolerance * root_mean_square(plan, trial_v_), round_off);
}

void NewtonKernel::solve(const Plan& plan, const Stage& stage, const NewtonLimits& limits, Field& V, Motion& motion) {
  if (moving_ == 0) return;
  const long factorizations_before = motion.factorizations;
  Curvature curvature = stage.b * plan.spectrum.omega > stiff ? Curvature::Clamped : Curvature::Exact;
  bool fresh_matrix = factored_b_ != stage.b;
  double size_before = 0.0;  // of the last step, if it was taken whole

  set_positions(stage, V, x_);
  Potential here = potential(plan, stage, x_, V);
  compute_residual(plan, stage, V, motion);
  for (int iteration = 0; iteration < limits.iterations; ++iteration) {
    if (fresh_matrix) {
      if (motion.factorizations - factorizations_before >= limits.factorizations) break;
      factorize(plan, stage, curvature, V, motion);
    }
    compute_step(plan, motion);

    // what is left after this step, from how much steps contract
    const double size = root_mean_square(plan, step_);
    const double contraction = size_before > 0.0 ? size / size_before : 1.0;
    const double left = contraction < 0.5 ? size * contraction / (1.0 - contraction) : size;
    if (left <= allowed_error(plan, stage, limits.tolerance, V)) {
      add_scaled(V.data(), 1.0, step_.data(), V.size());
      return;
    }

    // downhill, by Armijo's rule; what is lost in the rounding of Phi is taken as it is
    const double slope = dot(residual_, step_);
    constexpr double armijo = 1e-4, round_off = 1e-14;
    double share = 1.0;
    Potential there;
    for (;; share *= 0.5) {
      trial_v_ = V;
      add_scaled(trial_v_.data(), share, step_.data(), V.size());
      set_positions(stage, trial_v_, trial_x_);
      there = potential(plan, stage, trial_x_, trial_v_);
      if (there.value <= here.value + armijo * share * slope || -share * slope <= round_off * here.magnitude) break;
      if (share < 1e-9) break;
    }
    if (share < 1e-9) break;

    fresh_matrix = share < 1.0 || (size_before > 0.0 && contraction > slow);
    curvature = share < 1.0 ? Curvature::Clamped : Curvature::Exact;
    size_before = share < 1.0 ? 0.0 : size;
    std::swap(V, trial_v_);
    if (iteration == 0) go_to_rest_if_lower(plan, stage, V, there);
    compute_residual(plan, stage, V, motion);
    here = plan.has_dashpots() ? potential(plan, stage, x_, V) : there;
  }
  ++motion.unconverged_solves;
}

}  // namespace hooke
