// The table of integrators. Adding one is one file under integrators/ and one row in integrator.cpp; menus, help,
// documentation and the tests of order, amplification and stability are made from the rows.
#pragma once

#include <complex>
#include <string_view>

#include "base/table.h"
#include "sim/motion.h"

namespace hooke {

// The damped oscillator x'' = -omega^2 x - lambda x' - c x' (a dashpot and drag), seen by a step h: all dimensionless.
struct Oscillator {
  double h_omega_squared = 0.0;  // (h omega)^2
  double h_lambda = 0.0;
  double h_drag = 0.0;  // h c
};

// One step on it is a 2x2 matrix; its eigenvalues follow from these two.
struct Amplification {
  double trace = 2.0, determinant = 1.0;
};

// What a linear mode does under a method, undamped or not.
enum class Stability {
  None,         // an undamped mode grows at every step
  Conditional,  // none grows up to a largest step, which follows from the amplification
  Adaptive,     // the method picks its own steps within the one asked for
  EachSpring,   // a spring alone never grows and, when too fast for the step, dies out; many together promise nothing
  AStable,      // none grows at any step (A-stable)
  LStable,      // and modes far too fast for the step die out at once (L-stable)
};

// What becomes of the energy of an undamped scene over many steps.
enum class EnergyTrend { Grows, Drifts, Bounded, Falls };

// In words, for menus and documents.
std::string_view describe(Stability stability);
std::string_view describe(EnergyTrend energy);

struct Integrator {
  std::string_view id;       // on the command line and in files
  std::string_view label;    // in the menu
  std::string_view summary;  // one sentence: what it is for
  std::string_view cost;     // what a step costs, in force evaluations or factorisations
  std::string_view formula;  // one step of h, lines
  std::string_view source;   // who found or described it
  int order;                 // of positions and velocities, undamped
  int order_drag;            // with drag alone
  int order_damped;          // with dashpots
  int order_contact;         // undamped, through an impact
  Stability stability;
  EnergyTrend energy;
  bool symplectic;  // undamped
  // Robust enough to be left alone with a scene: the hard cases require that it succeeds at the smallest step tried. The others
  // are for teaching and comparison.
  bool for_production;
  // Once a frame, before its first step of h: sizes the workspace, computes what all steps of the frame share. May be null.
  void (*prepare)(const Plan& plan, double h, const Motion& motion, Workspace& work);
  void (*step)(const Plan& plan, Motion& motion, Workspace& work, double h);
  Amplification (*amplification)(const Oscillator& oscillator);  // closed form of one step
};

Table<Integrator> integrators();

// The row with this id, or null.
const Integrator* find_integrator(std::string_view id);

// The method for scenes so stiff that the default one would need more substeps than are allowed.
const Integrator& stiff_integrator();

// Amplification of a Runge-Kutta method with the stability function `r`: the eigenvalues of a step are r(h s) at the two
// roots s of s^2 + (lambda + c) s + omega^2.
Amplification amplification_from(std::complex<double> (*r)(std::complex<double>), const Oscillator& oscillator);

// Largest step [s] at which no mode within the spectrum grows: 0 when every step lets one grow (undamped explicit
// Euler), infinity when none does, or the method adapts its step. Where there is something to touch, no method's is infinite:
// a contact stops a point after the step, and springs too fast for the step make energy of the way that their ends went on.
double largest_stable_step(const Integrator& integrator, const Spectrum& spectrum);

}  // namespace hooke
