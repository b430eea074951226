// Implicit Euler by iterations with one constant matrix     (T. Liu, A. W. Bargteil, J. F. O'Brien, L. Kavan, Fast Simulation of
// Mass-Spring Systems, SIGGRAPH Asia 2013)
//   M (V - v0) = phi f(x + h V, V),  v0 = E v + phi M^-1 f_listed(x, v):   V <- V - A^-1 (M (V - v0) - phi f),  V = E v first,
//   A = M + phi L,   L = sum (h k + d) (s s^T) I, s = +-1 at the ends of a spring,   v' = V,  x' = x + h V,
// E = e^(-c h), phi = (1 - E) / c (h when c = 0). The local step (the vector of the rest length nearest to a spring) is in the force: these
// are the local and global steps of the paper (T. Liu, S. Bouaziz, L. Kavan, Quasi-Newton Methods, ACM TOG 2017). One scalar matrix serves
// all components; it depends on no position and is factored again only where masses, nails, springs, the hand or the step have changed.
// The derivative of no spring exceeds k I (of a cubic one: up to 100 % strain), so that every iteration brings the result closer to that of
// implicit Euler, and small vibrations are stable for any number: few iterations act as a larger mass. Departures: dashpots are part of the
// matrix, which slows what they do not damp; gravity is in the force instead of the initial guess, so that rest is rest.
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"
#include "sim/forces/kick.h"
#include "sim/forces/spring_laws.h"
#include "sim/methods/implicit/linear_solver.h"
#include "sim/methods/linear_spring.h"
#include "sim/methods/rows.h"
#include "sim/plan/phase_times.h"

namespace hooke {
namespace {

// Points at the ends of the packed springs.
std::vector<std::pair<Index, Index>> ends_of_springs(const Plan& plan) {
  std::vector<std::pair<Index, Index>> ends(plan.springs);
  for_each_spring(plan, [&](Index i, Index j, Index s) { ends[s] = {i, j}; });
  return ends;
}

// A, and its factor.
class GlobalMatrix final : public Structure {
 public:
  explicit GlobalMatrix(const Plan& plan) : Structure(plan), ends_(ends_of_springs(plan)) {}

  // For steps of h in which a force acts for phi [s].
  void prepare(const Plan& plan, double h, double phi) {
    const InPhase in(plan.execution.phases, Phase::Solve);
    set_weights(plan, h, phi);
    if (weights_ == factored_) return;
    factored_ = weights_;
    ++factorizations_;
    const std::size_t count = matrix_count(plan);
    while (solvers_.size() < count) solvers_.emplace_back(plan.points, 1, ends_);
    for (std::size_t c = 0; c < count; ++c) factorize(plan, c, solvers_[c]);
  }

  // b becomes A^-1 b. Counts its cost, and that of what `prepare` factored before.
  void solve(const Plan& plan, Field& b, StepCounts& counts) {
    const InPhase in(plan.execution.phases, Phase::Solve);
    const std::size_t n = plan.points;
    for (std::size_t at = 0; at < b.size(); at += n) solvers_[at / n % matrix_count(plan)].solve(std::span(b).subspan(at, n));
    clear_fixed_axes(plan, b.data());
    counts.factorizations += std::exchange(factorizations_, 0);
    ++counts.solves;
  }

 private:
  // One matrix for all components, except with rollers.
  static std::size_t matrix_count(const Plan& plan) {
    return plan.force_data.rollers.empty() ? 1 : static_cast<std::size_t>(plan.dimensions);
  }

  // The matrix of component c.
  void factorize(const Plan& plan, std::size_t c, LinearSolver& solver) {
    solver.set_zero();
    const std::size_t springs = ends_.size();
    for (Index i = 0; i < plan.points; ++i) *solver.diagonal(i).start = weights_[springs + i] + fixed_mass(plan, i, static_cast<int>(c));
    for (std::size_t s = 0; s < springs; ++s) {
      const auto [i, j] = ends_[s];
      const bool first_moves = plan.inverse_mass[i] != 0.0, second_moves = plan.inverse_mass[j] != 0.0;
      if (first_moves) *solver.diagonal(i).start += weights_[s];
      if (second_moves) *solver.diagonal(j).start += weights_[s];
      if (first_moves && second_moves) *solver.coupling(i, j).start -= weights_[s];
    }
    solver.factorize();
  }

  // For the packed springs, with stiffnesses that no derivative of a force exceeds (of a cubic one up to 100 % strain), and for the points.
  // The hand's pull k |sum w x - target|^2 / 2 is bounded by k sum w x^2 / 2.
  void set_weights(const Plan& plan, double h, double phi) {
    const std::size_t springs = ends_.size();
    weights_.resize(springs + 2 * plan.points + plan.force_data.rollers.fixed.size());
    const LawSprings& laws = plan.spring.laws;
    for (std::size_t s = 0; s < springs; ++s) {
      const LawSpring* law = laws.empty() || laws.of_packed[s] == no_index ? nullptr : &laws.springs[laws.of_packed[s]];
      const double k = law != nullptr ? max_stiffness(law->law, law->stiffness, law->rest_length) : plan.spring.stiffness[s];
      const double d = law != nullptr ? law->damping : plan.has_dashpots() ? plan.spring.damping[s] : 0.0;
      weights_[s] = phi * (h * k + d);
    }
    std::ranges::copy(plan.mass, weights_.begin() + springs);
    std::ranges::copy(plan.inverse_mass, weights_.begin() + springs + plan.points);
    std::ranges::copy(plan.force_data.rollers.fixed, weights_.begin() + springs + 2 * plan.points);
    if (!plan.hand.pull) return;
    for (const auto& [point, weight] : plan.hand.pull->points())
      if (plan.inverse_mass[point] != 0.0) weights_[springs + point] += phi * h * plan.hand.pull->stiffness * weight;
  }

  std::vector<std::pair<Index, Index>> ends_;
  std::vector<LinearSolver> solvers_;
  std::vector<double> weights_, factored_;
  int factorizations_ = 0;
};

// None in a scene in which nothing moves.
bool has_free_point(const Plan& plan) {
  return std::ranges::any_of(plan.inverse_mass, [](double w) { return w != 0.0; });
}

void prepare(const Plan& plan, double h, const Motion& motion, Workspace& work) {
  work.size_fields(3, motion);
  if (has_free_point(plan)) make_structure<GlobalMatrix>(plan, work).prepare(plan, h, kick_over(plan.drag, h).weight);
}

// E v, and v0 in `target`.
void predict(const Plan& plan, Motion& motion, double h, Field& target) {
  std::ranges::fill(motion.a, 0.0);
  add_force_terms(plan, motion.time, motion.x, motion.v, motion.a);
  divide_by_mass(plan, motion.a);
  predict_velocity(plan, motion, h, target);
  std::ranges::fill(motion.a, 0.0);
  kick(plan, motion, h);
  motion.acceleration_is_current = false;
}

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  Field &target = work.fields[0], &x = work.fields[1], &residual = work.fields[2];
  const double phi = kick_over(plan.drag, h).weight;
  predict(plan, motion, h, target);

  for (int n = 0; n < work.iterations && has_free_point(plan); ++n) {
    std::ranges::copy(motion.x, x.begin());
    add_scaled(x.data(), h, motion.v.data(), x.size());
    compute_unlisted_forces(plan, motion.time + h, x, plan.has_dashpots() ? &motion.v : nullptr, residual);
    for (std::size_t at = 0; at < residual.size(); ++at) {
      const std::size_t i = at % plan.points;
      residual[at] = plan.inverse_mass[i] == 0.0 ? 0.0 : phi * residual[at] - plan.mass[i] * (motion.v[at] - target[at]);
    }
    ++motion.counts.force_evaluations;
    structure_of<GlobalMatrix>(work).solve(plan, residual, motion.counts);
    add_scaled(motion.v.data(), 1.0, residual.data(), residual.size());
  }
  drift(motion, h);
}

}  // namespace

constinit const Integrator projective_dynamics{
    .id = "projective_dynamics",
    .label = "Projective dynamics (local/global)",
    .summary =
        "Implicit Euler by cheap iterations with one matrix that is factored beforehand, for comparison: stable at any step, and sluggish.",
    .cost =
        "for each iteration, one force evaluation and one solve per step; a factorization where springs, masses, nails or the step change",
    .formula =
        "V = E v,   E = e^(-c h), phi = (1 - E) / c,   v0 = E v + phi M^-1 f_listed(x, v)\n"
        "repeat:  V = V - A^-1 (M (V - v0) - phi f(x + h V, V)),   A = M + phi sum (h k + d) s s^T\n"
        "v' = V,  x' = x + h V",
    .source = "T. Liu, A. W. Bargteil, J. F. O'Brien, L. Kavan, Fast Simulation of Mass-Spring Systems, ACM Trans. Graph. 32 (2013) 214",
    .order = 1,
    .order_with = {.drag = 1, .damped = 1, .contact = 1, .force_terms = 1},
    .stability = Stability::LStable,
    .energy = EnergyTrend::Falls,
    .implicit_solve = ImplicitSolve::Repeated,
    .for_production = false,
    .velocity_lag = 0.5,
    .prepare = prepare,
    .step = step,
    .amplification = amplification_of_linear_spring,
};

}  // namespace hooke
