// A (v' - v) = h f(x + h v, v) ...
#include "sim/integrators/rows.h"
#include "sim/newton.h"

namespace hooke {
namespace {

void prepare(const Plan& plan, double, const Motion& motion, Workspace& work) {
  work.size_fields(1, motion);
  make_structure<NewtonKernel>(plan, work).begin_frame(plan, motion);
}

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  Field& V = work.fields[0];
  V = motion.v;
  structure_of<NewtonKernel>(work).solve_once(plan, {motion.time + h, h, motion.x, motion.v}, V, motion);
  motion.v = V;
  drift(motion, h);
}

// r(z) = 1 / (1 - z), as implicit Euler: one iteration solves what is linear
Amplification amplification(const Oscillator& oscillator) {
  return amplification_from([](std::complex<double> z) { return 1.0 / (1.0 - z); }, oscillator);
}

}  // namespace

constinit const Integrator baraff_witkin{
    .id = "baraff_witkin",
    .label = "Baraff-Witkin (one Newton step)",
    .summary = "The fallback for scenes that nothing else can follow: one linear solve a step, strongly damped, first order.",
    .needs = "one factorisation and one solve a step",
    .order = 1,
    .order_drag = 1,
    .order_damped = 1,
    .order_contact = 1,
    .stability = Stability::Stiff,
    .energy = EnergyTrend::Falls,
    .symplectic = false,
    .prepare = prepare,
    .step = step,
    .amplification = amplification,
};

}  // namespace hooke
