// Springs as compliant constraints, one after another, once a step     (M. Macklin, M. Mueller, N. Chentanez, XPBD, MIG 2016;
// one iteration and small steps: M. Macklin et al., Small Steps in Physics Simulation, SCA 2019)
//   v = v E + phi g,  then for every spring:  v_i += w_i J u,  v_j -= w_j J u,   and x' = x + h v,
//   J = -(phi k (l - l0) + phi d (v_i - v_j).u) / (1 + phi (h k + d)(w_i + w_j)),   l and u at x + h v,
// E = e^(-c h), phi = (1 - E) / c (h when c = 0), w = 1 / m. With phi = h this is the paper's correction of positions
// lambda = (-C - gamma grad C.(x - x_n)) / ((1 + gamma) w + alpha / h^2), alpha = 1 / k, gamma = d / (k h), times k h. Departures:
// corrections go to the velocity, so that (x' - x) / h leaves no floor at small steps; phi in place of h gives drag its
// exact decay and keeps equilibria where they are.
// Each spring alone is damped as by implicit Euler; coupled springs converge only as far as one sweep reaches, so that long chains, or
// chains of very different masses, are far too soft. The order of the springs decides whether the motion stays bounded: springs of one
// color share no point and are processed along one direction of a grid after another.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sim/forces/forces.h"
#include "sim/integrators/rows.h"
#include "sim/portable_math.h"

namespace hooke {
namespace {

struct Constraint {
  Index first, second, spring;
  double rest_length;
  double stiffness, damping;  // phi k and phi d over the denominator [N s/m], [kg]
};

// The order of the springs. Colors are assigned greedily to the springs sorted by the distance of their
// ends in the list of points, which on a grid is by direction.
class ColoredSprings : public Structure {
 public:
  explicit ColoredSprings(const Plan& plan) : Structure(plan) {
    for (const SpringRun& run : plan.runs)
      for (Index e = 0; e < run.count; ++e) constraints.push_back({run.first + e, run.second + e, run.begin + e, 0.0, 0.0, 0.0});
    std::stable_sort(constraints.begin(), constraints.end(),
                     [](const Constraint& a, const Constraint& b) { return a.second - a.first < b.second - b.first; });

    std::vector<std::vector<std::uint64_t>> used_colors(plan.points);  // 64 colors per word
    std::vector<std::vector<Constraint>> colors;
    for (const Constraint& constraint : constraints) {
      const std::size_t color = assign_color(used_colors[constraint.first], used_colors[constraint.second]);
      colors.resize(std::max(colors.size(), color + 1));
      colors[color].push_back(constraint);
    }
    constraints.clear();
    for (const auto& color : colors) constraints.insert(constraints.end(), color.begin(), color.end());
  }

  std::vector<Constraint> constraints;

 private:
  static std::size_t assign_color(std::vector<std::uint64_t>& first, std::vector<std::uint64_t>& second) {
    for (std::size_t word = 0;; ++word) {
      first.resize(std::max(first.size(), word + 1));
      second.resize(std::max(second.size(), word + 1));
      const std::uint64_t free = ~(first[word] | second[word]);
      if (free == 0) continue;
      const std::uint64_t lowest = free & (~free + 1);
      first[word] |= lowest;
      second[word] |= lowest;
      return 64 * word + static_cast<std::size_t>(std::countr_zero(lowest));
    }
  }
};

double drag_weight(double drag, double h) { return drag == 0.0 ? h : -portable::expm1(-drag * h) / drag; }

void prepare(const Plan& plan, double h, const Motion&, Workspace& work) {
  const double phi = drag_weight(plan.drag, h);
  for (Constraint& constraint : make_structure<ColoredSprings>(plan, work).constraints) {
    const double k = plan.stiffness[constraint.spring], d = plan.has_dashpots() ? plan.damping[constraint.spring] : 0.0;
    const double factor = phi / (1.0 + phi * (h * k + d) * (plan.inverse_mass[constraint.first] + plan.inverse_mass[constraint.second]));
    constraint.rest_length = plan.rest_length[constraint.spring];
    constraint.stiffness = factor * k;
    constraint.damping = factor * d;
  }
}

// x are the positions at the start of the step.
template <int Dimensions>
void sweep(const Plan& plan, const std::vector<Constraint>& constraints, double h, const double* x, double* v) {
  const std::size_t n = plan.points;
  const double* w = plan.inverse_mass.data();
  for (const Constraint& constraint : constraints) {
    const std::size_t i = constraint.first, j = constraint.second;
    double along[Dimensions], length_squared = 0.0, approach = 0.0;
    for (int c = 0; c < Dimensions; ++c) {
      const double relative_velocity = v[c * n + i] - v[c * n + j];
      along[c] = x[c * n + i] - x[c * n + j] + h * relative_velocity;
      length_squared += along[c] * along[c];
      approach += along[c] * relative_velocity;
    }
    if (length_squared == 0.0) continue;
    const double length = std::sqrt(length_squared);
    const double impulse = (constraint.stiffness * (length - constraint.rest_length) + constraint.damping * approach / length) / length;
    for (int c = 0; c < Dimensions; ++c) {
      v[c * n + i] -= w[i] * impulse * along[c];
      v[c * n + j] += w[j] * impulse * along[c];
    }
  }
}

// The hand's spring has no rest length: all of its displacement is along it.
void pull(const Plan& plan, Motion& motion, double h) {
  const PlannedPull& hand = *plan.pull;
  const double k = hand.stiffness, phi = drag_weight(plan.drag, h);
  double w = 0.0;
  for (const auto& [point, weight] : hand.points()) w += weight * weight * plan.inverse_mass[point];
  const double stiffness = phi * k / (1.0 + phi * h * k * w);
  const Vec3 target = hand.target_at(motion.time + h);
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * plan.points;
    const double impulse = stiffness * (hand.interpolate(&motion.x[begin]) + h * hand.interpolate(&motion.v[begin]) - target[c]);
    for (const auto& [point, weight] : hand.points()) motion.v[begin + point] -= plan.inverse_mass[point] * weight * impulse;
  }
}

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  // gravity alone is constant
  if (!motion.acceleration_is_current || !plan.forces.empty()) {
    compute_external_forces(plan, motion.time, motion.x, motion.v, motion.a);
    divide_by_mass(plan, motion.a);
    motion.acceleration_is_current = true;
  }

  kick(plan, motion, h);

  const std::vector<Constraint>& constraints = structure_of<ColoredSprings>(work).constraints;
  if (plan.dimensions == 2)
    sweep<2>(plan, constraints, h, motion.x.data(), motion.v.data());
  else
    sweep<3>(plan, constraints, h, motion.x.data(), motion.v.data());
  if (plan.pull) pull(plan, motion, h);
  ++motion.sweeps;

  drift(motion, h);
}

// x' = x + h v',  v' = ((E - phi q) v - phi omega^2 x) / (1 + phi (h omega^2 + lambda))
Amplification amplification(const Oscillator& oscillator) {
  const double phi = drag_weight(oscillator.h_drag, 1.0), decay = portable::exp(-oscillator.h_drag) - phi * oscillator.h_rate;
  const double denominator = 1.0 + phi * (oscillator.h_omega_squared + oscillator.h_lambda);
  return {.trace = 1.0 + (decay - phi * oscillator.h_omega_squared) / denominator, .determinant = decay / denominator};
}

}  // namespace

constinit const Integrator xpbd{
    .id = "xpbd",
    .label = "XPBD, one iteration",
    .summary = "Stiff cloth in real time with large errors: bounded at steps far beyond the explicit limit, and too soft there.",
    .cost = "one sweep over the springs per step",
    .formula =
        "v = E v + phi g,   E = e^(-c h), phi = (1 - E) / c\n"
        "for every spring:  J = -phi (k (l - l0) + d (v_i - v_j).u) / (1 + phi (h k + d)(w_i + w_j)),   l, u at x + h v, w = 1/m\n"
        "                   v_i += w_i J u,  v_j -= w_j J u\n"
        "x' = x + h v",
    .source = "M. Macklin, M. Mueller, N. Chentanez, XPBD, MIG 2016; M. Macklin et al., Small Steps in Physics Simulation, SCA 2019",
    .order = 1,
    .order_drag = 1,
    .order_damped = 1,
    .order_contact = 1,
    .order_friction = 1,
    .order_force_terms = 1,
    .stability = Stability::EachSpring,
    .energy = EnergyTrend::Falls,
    .symplectic = false,
    .implicit_solve = ImplicitSolve::None,
    .implicit_force_terms = false,
    .for_production = true,
    .prepare = prepare,
    .step = step,
    .amplification = amplification,
};

}  // namespace hooke
