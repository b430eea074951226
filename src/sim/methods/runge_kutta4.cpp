// k1 = f(y), k2 = f(y + h/2 k1), k3 = f(y + h/2 k2), k4 = f(y + h k3),  y' = y + h/6 (k1 + 2 k2 + 2 k3 + k4)
// (Kutta 1901; explicit_runge_kutta.h), y = (x, v). Fourth order with damping and drag too; stable for h omega < 2.83, h lambda < 2.78;
// energy drifts slowly.
#include "sim/methods/explicit_runge_kutta.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

constexpr std::size_t stages = 4;
using Step = RungeKuttaStep<stages>;

constexpr RungeKuttaTable<stages> table({{{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}}}, {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0});

void prepare(const Plan&, double, const Motion& motion, Workspace& work) { Step::prepare(motion, work); }

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  Step step(table, plan, motion, work, h);
  step.compute_slopes();
  step.finish();
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
    .order_with = {.drag = 4, .damped = 4, .contact = 2, .force_terms = 4},
    .stability = Stability::Conditional,
    .energy = EnergyTrend::Drifts,
    .prepare = prepare,
    .step = step,
    .amplification = amplification,
};

}  // namespace hooke
