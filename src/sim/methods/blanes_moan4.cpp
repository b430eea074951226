// Kicks b_i h and drifts a_i h in turn, b_1 a_1 b_2 ... a_6 b_7, symmetric     (S. Blanes, P. C. Moan, Practical symplectic
// partitioned Runge-Kutta and Runge-Kutta-Nystroem methods, J. Comput. Appl. Math. 142 (2002) 313-330, SRKN_6^b)
// Fourth order, symplectic, stable to h omega = 3.163; beyond a resonance that ends at 3.169 it is stable again, to 5.02, but a large scene
// has modes in the whole range. Drag is part of the kicks and exact there; because it is symmetric, the composition keeps its fourth order
// with drag, although the conditions of the paper are for forces without velocities. Dashpots are split off as in velocity_verlet, which
// makes it second order with them. The same holds for forces that depend on velocity.
#include <array>

#include "sim/forces/dashpots/dashpot.h"
#include "sim/forces/forces.h"
#include "sim/forces/kick.h"
#include "sim/forces/leapfrog_pass.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

constexpr int drifts = 6;

constexpr std::array<double, drifts + 1> kick_weight = [] {
  constexpr double b1 = 0.0829844064174052, b2 = 0.396309801498368, b3 = -0.0390563049223486;
  return std::array{b1, b2, b3, 1.0 - 2.0 * (b1 + b2 + b3), b3, b2, b1};
}();

constexpr std::array<double, drifts> drift_weight = [] {
  constexpr double a1 = 0.245298957184271, a2 = 0.604872665711080;
  return std::array{a1, a2, 0.5 - (a1 + a2), 0.5 - (a1 + a2), a2, a1};
}();

// Forces that depend on velocity are evaluated at the start of the first kick, at the middle of the others, and at the end of the
// last: symmetric.
constexpr double prediction_weight(int kick) { return kick == drifts ? kick_weight[kick] : 0.5 * kick_weight[kick]; }

void prepare(const Plan& plan, double h, const Motion& motion, Workspace& work) {
  work.size_fields(plan.force_data.depend_on_velocity ? 1 : 0, motion);
  if (plan.has_dashpots()) work.dashpots.prepare(plan, 0.5 * h);
}

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  const bool damped = plan.has_dashpots();
  if (damped) work.dashpots.sweep(plan, SweepDirection::Forward, motion.time, motion.x, motion.v);

  start_kick_and_drift(plan, motion, kick_weight[0] * h, drift_weight[0] * h);
  double time = motion.time;
  Field& velocity = work.fields[0];
  for (int i = 0; i < drifts; ++i) {
    time += drift_weight[i] * h;
    const double next_drift = i + 1 < drifts ? drift_weight[i + 1] * h : 0.0;
    if (!plan.force_data.depend_on_velocity) {
      accelerate_kick_and_drift(plan, time, motion, kick_weight[i + 1] * h, next_drift);
      continue;
    }
    predict_velocity(plan, motion, prediction_weight(i + 1) * h, velocity);
    compute_position_forces(plan, time, motion.x, velocity, motion.a);
    divide_by_mass(plan, motion.a);
    ++motion.counts.force_evaluations;
    kick_and_drift(plan, motion, kick_weight[i + 1] * h, next_drift);
  }
  motion.acceleration_is_current = !plan.force_data.depend_on_velocity;

  if (damped) work.dashpots.sweep(plan, SweepDirection::Backward, motion.time + h, motion.x, motion.v);
  motion.counts.dashpot_sweeps += damped ? 2 : 0;
}

// The columns of the step's matrix on (x, h v): kicks v' = E v + phi a, E = e^(-c b h), phi = (1 - E) / c.
Amplification amplification(const Oscillator& oscillator) {
  const double drag = oscillator.h_drag, dashpot = portable::exp(-0.5 * oscillator.h_lambda);
  double x[] = {1.0, 0.0}, v[] = {0.0, dashpot};
  for (int column = 0; column < 2; ++column) {
    double a = 0.0;
    for (int i = 0; i <= drifts; ++i) {
      const double weight = i == 0 ? 0.0 : prediction_weight(i);
      const Kick<double> predicted = kick_over(drag, weight), kick = kick_over(drag, kick_weight[i]);
      const double velocity = predicted.decay * v[column] + predicted.weight * a;
      a = -oscillator.h_omega_squared * x[column] - oscillator.h_rate * velocity;
      v[column] = kick.decay * v[column] + kick.weight * a;
      if (i < drifts) x[column] += drift_weight[i] * v[column];
    }
  }
  // kicks and drifts preserve areas, except with drag, dashpots and forces that depend on velocity
  const double determinant = oscillator.h_rate == 0.0 ? dashpot * dashpot * portable::exp(-drag) : dashpot * (x[0] * v[1] - x[1] * v[0]);
  return {.trace = x[0] + dashpot * v[1], .determinant = determinant};
}

}  // namespace

constinit const Integrator blanes_moan4{
    .id = "blanes_moan4",
    .label = "Blanes-Moan 4",
    .summary = "Fourth order without energy drift: the cheapest for small errors in scenes without dashpots.",
    .cost = "six force evaluations per step; two sweeps over the dashpots",
    .formula =
        "kick b1 h, drift a1 h, kick b2 h, ... drift a6 h, kick b7 h,   b and a symmetric\n"
        "dashpots split off as in velocity_verlet",
    .source = "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313-330, SRKN_6^b",
    .order = 4,
    .order_with = {.drag = 4, .damped = 2, .contact = 2, .force_terms = 2},
    .stability = Stability::Conditional,
    .energy = EnergyTrend::Bounded,
    .splits_dashpots = true,
    .prepare = prepare,
    .step = step,
    .amplification = amplification,
};

}  // namespace hooke
