// Kick h/2, drift h, kick h/2:  v = v E + a(x, v) phi,  x' = x + h v,  v' = v E + a(x', v) phi, as velocity_verlet (E and phi there), but
// with the dashpots among the forces: those at the end of a step follow the velocity at its middle, which makes it first order with them.
// The coefficient is h times the rate of the dashpots, so that the error is that of second order while they are weak. Within a frame it
// takes the steps of symplectic_euler, one pass over the springs each instead of three; half a kick at both ends of the frame makes
// the difference of an order.
#include "sim/step/automatic/leapfrog.h"

#include "sim/forces/forces.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

void accelerate(const Plan& plan, Motion& motion) {
  compute_explicit_forces(plan, motion.time, motion.x, motion.v, motion.a);
  divide_by_mass(plan, motion.a);
  ++motion.counts.force_evaluations;
}

void step(const Plan& plan, Motion& motion, Workspace&, double h) {
  if (!motion.acceleration_is_current) accelerate(plan, motion);
  kick(plan, motion, 0.5 * h);
  drift(motion, h);
  const double start = motion.time;
  motion.time += h;
  accelerate(plan, motion);
  motion.time = start;
  kick(plan, motion, 0.5 * h);
  motion.acceleration_is_current = true;
}

// The steps between the half kicks are those of symplectic Euler.
Amplification amplification(const Oscillator& oscillator) { return symplectic_euler.amplification(oscillator); }

}  // namespace

const Integrator* find_chosen_method(std::string_view id) { return id == leapfrog.id ? &leapfrog : find_integrator(id); }

constinit const Integrator leapfrog{
    .id = "leapfrog",
    .label = "Leapfrog",
    .summary = "Velocity Verlet with weak dashpots among the forces: one pass over the springs per step. Chosen by `auto` alone.",
    .cost = "one force evaluation per step",
    .formula =
        "v = E v + phi a(x, v),   E = e^(-c h/2), phi = (1 - E) / c\n"
        "x' = x + h v\n"
        "v' = E v + phi a(x', v)",
    .source = "R. W. Hockney, J. W. Eastwood, Computer Simulation Using Particles, 1981, section 4-4",
    .order = 2,
    .order_with = {.drag = 2, .damped = 1, .contact = 2, .friction = 1, .force_terms = 2},
    .stability = Stability::Conditional,
    .energy = EnergyTrend::Bounded,
    .symplectic = true,
    .implicit_solve = ImplicitSolve::None,
    .implicit_force_terms = false,
    .for_production = true,
    .prepare = nullptr,
    .step = step,
    .amplification = amplification,
};

}  // namespace hooke
