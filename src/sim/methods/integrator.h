// The table of integrators. Adding one is one file under integrators/ and one line in its list.inc; menus, help,
// documentation and the tests of order, amplification and stability are made from the rows.
#pragma once

#include <complex>
#include <string>
#include <string_view>

#include "base/table.h"
#include "sim/forces/motion.h"
#include "sim/methods/constants.h"

namespace hooke {

// The damped oscillator x'' = -omega^2 x - (lambda + c + q) x' (a dashpot, drag and a listed force) and a step h: all dimensionless.
struct Oscillator {
  double h_omega_squared = 0.0;  // (h omega)^2
  double h_lambda = 0.0;
  double h_drag = 0.0;  // h c
  double h_rate = 0.0;  // h q, of a listed force -q m v
};

// The eigenvalues z of one step on it: z^2 - trace z + determinant = 0; or, of a method that keeps the acceleration of the step before,
// z^3 - trace z^2 + determinant z - third = 0.
struct Amplification {
  double trace = 2.0, determinant = 1.0, third = 0.0;
};

// Stability of a linear mode, undamped or damped.
enum class Stability {
  None,         // an undamped mode grows at any step size
  Conditional,  // none grows up to a largest step, which follows from the amplification
  Adaptive,     // the method chooses its own steps within the given one
  EachSpring,   // a single spring never grows and decays if too fast for the step; nothing is guaranteed for coupled springs
  AStable,      // none grows at any step (A-stable)
  LStable,      // and modes far too fast for the step decay at once (L-stable)
};

// The energy of an undamped scene over many steps.
enum class EnergyTrend { Grows, Drifts, Bounded, Falls };

// How a step solves its implicit equations.
enum class ImplicitSolve {
  None,       // there are none, or they are solved spring by spring or point by point
  Once,       // linearized at the start of the step: one linear system
  Iterative,  // by Newton's method, to a tolerance or to its limit of iterations
  Repeated,   // spring by spring or point by point, by Settings::iterations iterations
};

// As text, for menus and documents.
std::string_view describe(Stability stability);
std::string_view describe(EnergyTrend energy);

// Of positions and velocities of every method, through an impact and sliding under friction, on planes and spheres.
inline constexpr int friction_order = 1;

// Of positions and velocities too.
struct OrdersWith {
  int drag;         // alone
  int damped;       // with dashpots
  int contact;      // undamped, through an impact of any restitution, and sliding without friction
  int force_terms;  // with listed forces, those that depend on velocity included
};

struct Integrator {
  // The label without what it has in parentheses, for sentences.
  std::string short_name() const { return std::string(label.substr(0, label.find(" ("))); }
  bool is_symplectic() const { return energy == EnergyTrend::Bounded; }  // undamped
  bool iterates() const { return implicit_solve == ImplicitSolve::Repeated; }
  // Whether listed forces are part of an implicit system. If not, they limit the step also of a method that is otherwise stable at any
  // step.
  bool is_implicit() const { return implicit_solve == ImplicitSolve::Once || implicit_solve == ImplicitSolve::Iterative; }

  std::string_view id;       // on the command line and in files
  std::string_view label;    // in the menu
  std::string_view summary;  // one sentence: when to use it
  std::string_view cost;     // cost of a step, in force evaluations or factorizations
  std::string_view formula;  // one step of h, lines
  std::string_view source;   // the publication
  int order;                 // of positions and velocities, undamped
  OrdersWith order_with;
  Stability stability;
  EnergyTrend energy;
  ImplicitSolve implicit_solve = ImplicitSolve::None;
  // Robust enough for unattended use: the hard cases require that it succeeds at the smallest step tried. The others are for teaching and
  // comparison.
  bool for_production = true;
  // [1], by how much of a step its velocity is behind its position: half a step where x' = x + h v', and -1/2 where x' = x + h v.
  double velocity_lag = 0.0;
  // Whether dashpots are solved exactly, apart from all other forces: with second order only while they decay little within a step.
  bool splits_dashpots = false;
  // Called once per frame, before its first step of h: sizes the workspace and computes what is common to all steps. May be null.
  void (*prepare)(const Plan& plan, double h, const Motion& motion, Workspace& work) = nullptr;
  // One step of h; null: the method chooses its own steps.
  void (*step)(const Plan& plan, Motion& motion, Workspace& work, double h) = nullptr;
  // One step of the method's own length, at most `interval` [s], from motion.time, which stays. Returns its length, `interval` itself if
  // it reaches the end; 0: no step is short enough for a finite error. Null: the method takes the step it is given.
  double (*advance)(const Plan& plan, Motion& motion, Workspace& work, double interval) = nullptr;
  Amplification (*amplification)(const Oscillator& oscillator) = nullptr;  // closed form of one step
  // [J], the leading terms of the modified energy, which the method conserves to a higher order than the energy of the scene, less the
  // latter, at the end of a step of h. Null: not known.
  double (*modified_energy)(const Plan& plan, const Motion& motion, double h) = nullptr;
  // `count` steps of h with nothing between them, in a scene without listed forces and hand: equal to that many calls of `step` to
  // round-off. Adds to motion.time. Null: a step is no cheaper for it.
  void (*steps)(const Plan& plan, Motion& motion, Workspace& work, double h, int count) = nullptr;
};

Table<Integrator> integrators();

// The row with this id, also `auto` (automatic.h), or null.
const Integrator* find_integrator(std::string_view id);

// The method for scenes so stiff that the default one would need more substeps than are allowed.
const Integrator& stiff_integrator();

// The method for motion that takes very short steps in small parts of it.
const Integrator& adaptive_integrator();

// Amplification of a Runge-Kutta method with the stability function `r`: the eigenvalues of a step are r(h s) at the two
// roots s of s^2 + (lambda + c) s + omega^2.
Amplification amplification_from(std::complex<double> (*r)(std::complex<double>), const Oscillator& oscillator);

// The linear limit: the largest step [s] at which no linear mode within the spectrum grows. 0 if a mode grows at every step (undamped
// explicit Euler), infinity if none does or the method adapts its step. In scenes with contact it is finite for every method: contact stops
// a point after the step, and springs too fast for the step convert that correction into energy.
double largest_stable_step(const Integrator& integrator, const Spectrum& spectrum);

// The factor by which the step should be below the linear limit in a run from this state.
int recommended_margin(const System& system, const State& state);

}  // namespace hooke
