// x' = x + h v,  v' = v + h a(x, v)     (Euler 1768)
// First order. Every undamped mode grows by sqrt(1 + (h omega)^2) per step, which demonstrates instability.
#include "sim/forces/forces.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

void step(const Plan& plan, Motion& motion, Workspace&, double h) {
  compute_accelerations(plan, motion.time, motion.x, motion.v, motion.a);
  ++motion.counts.force_evaluations;

  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    motion.x[i] += h * motion.v[i];
    motion.v[i] += h * motion.a[i];
  }
}

Amplification amplification(const Oscillator& oscillator) {
  return amplification_from([](std::complex<double> z) { return 1.0 + z; }, oscillator);
}

}  // namespace

constinit const Integrator explicit_euler{
    .id = "explicit_euler",
    .label = "Explicit Euler",
    .summary = "The simplest method, to demonstrate instability: without damping it gains energy at every step size.",
    .cost = "one force evaluation per step",
    .formula =
        "x' = x + h v\n"
        "v' = v + h a(x, v)",
    .source = "L. Euler, Institutiones calculi integralis, 1768",
    .order = 1,
    .order_with = {.drag = 1, .damped = 1, .contact = 1, .force_terms = 1},
    .stability = Stability::None,
    .energy = EnergyTrend::Grows,
    .for_production = false,
    .velocity_lag = -0.5,
    .step = step,
    .amplification = amplification,
};

}  // namespace hooke
