// k1 = f(y), k2 = f(y + h/2 k1), k3 = f(y + h/2 k2), k4 = f(y + h k3),  y' = y + h/6 (k1 + 2 k2 + 2 k3 + k4)
// (Kutta 1901), y = (x, v). Fourth order with damping and drag too; stable for h omega < 2.83, h lambda < 2.78; energy
// drifts slowly.
#include <algorithm>

#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"
#include "sim/integrators/rows.h"

namespace hooke {
namespace {

void prepare(const Plan&, double, const Motion& motion, Workspace& work) { work.size_fields(5, motion); }

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  Field &x = work.fields[0], &v = work.fields[1], &a = work.fields[2], &sum_v = work.fields[3], &sum_a = work.fields[4];
  constexpr double node[] = {0.0, 0.5, 0.5, 1.0};
  constexpr double weight[] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  std::ranges::fill(sum_v, 0.0);
  std::ranges::fill(sum_a, 0.0);

  for (int stage = 0; stage < 4; ++stage) {
    const Field &stage_x = stage == 0 ? motion.x : x, &stage_v = stage == 0 ? motion.v : v;
    compute_forces(plan, motion.time + h * node[stage], stage_x, stage_v, a);
    ++motion.force_evaluations;

    // the slopes (v, a), and from them the state of the next stage
    const double next_step = stage < 3 ? h * node[stage + 1] : 0.0;
    const auto n = static_cast<std::size_t>(plan.points);
    for (std::size_t at = 0; at < a.size(); at += n)
      add_slope({&motion.x[at], &motion.v[at], &stage_v[at], &a[at], &sum_v[at], &sum_a[at], &x[at], &v[at]}, plan.inverse_mass.data(),
                weight[stage], next_step, n);
  }
  add_scaled(motion.x.data(), h, sum_v.data(), motion.x.size());
  add_scaled(motion.v.data(), h, sum_a.data(), motion.v.size());
}

Amplification amplification(const Oscillator& oscillator) {
  return amplification_from([](std::complex<double> z) { return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))); },
                            oscillator);
}

}  // namespace

constinit const Integrator runge_kutta4{
    .id = "runge_kutta4",
    .label = "Runge-Kutta 4",
    .summary = "The classic fourth-order method: accurate for damped scenes and small steps; energy drifts slowly.",
    .cost = "four force evaluations per step",
    .formula =
        "k1 = f(y), k2 = f(y + h/2 k1), k3 = f(y + h/2 k2), k4 = f(y + h k3),   y = (x, v)\n"
        "y' = y + h/6 (k1 + 2 k2 + 2 k3 + k4)",
    .source = "W. Kutta, Z. Math. Phys. 46 (1901) 435-453",
    .order = 4,
    .order_drag = 4,
    .order_damped = 4,
    .order_contact = 2,
    .order_friction = 1,
    .order_force_terms = 4,
    .stability = Stability::Conditional,
    .energy = EnergyTrend::Drifts,
    .symplectic = false,
    .implicit_solve = ImplicitSolve::None,
    .implicit_force_terms = false,
    .for_production = true,
    .prepare = prepare,
    .step = step,
    .amplification = amplification,
};

}  // namespace hooke
