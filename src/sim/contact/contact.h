// Points against solid colliders: plane, sphere, box, each inflated by the point's radius; and against each other (pair_solver.h), with
// restitution and Coulomb friction. Last, faces and springs against each other (surface_solver.h).
#pragma once

#include <vector>

#include "sim/contact/obstacle.h"
#include "sim/contact/pair_solver.h"
#include "sim/contact/resting_kernel.h"
#include "sim/contact/surface/surface_solver.h"
#include "sim/forces/energy/power_work.h"
#include "sim/forces/motion.h"

namespace hooke {

// Positions and velocities before a substep, and the motion of the colliders during it; sized once per frame.
struct ContactWorkspace {
  double time = 0.0;          // [s]
  double velocity_lag = 0.0;  // [1], of the method (integrator.h)
  // [1], the same if the path under friction must be the method's own, x' = x + h v', so that vibrations along a surface gain no energy;
  // otherwise 0.
  double friction_lag = 0.0;
  Field x, v;
  // Velocities at the end of the substep before the strain limit changed them, if it did: what it changes is no work of forces.
  Field unlimited_v;
  bool is_limited = false;
  Field free_v;   // velocities at the end of the substep before contact changed them
  Field impulse;  // [N s], of contact before the substep, of a method that may take it back
  std::vector<Obstacle> obstacles;
  // [s], since the start of the substep, when the first point touched something, and when the first had an impact; infinity: none did
  double first_touch = 0.0, first_impact = 0.0;
  // Of each point: what became of it, and the work of the contact [J] in addition to the work of the forces.
  std::vector<RestingPoints::Outcome> outcome;
  std::vector<double> work;
  std::vector<Vec3> push_out;        // [m], of each point, out of colliders in which it was before the substep
  Field without_push;                // [m], positions after the substep without that
  std::vector<Vec3> displaced;       // [m], of each point, by impacts
  const PowerWork* works = nullptr;  // work of the dashpots in this step; null: not integrated by sweeps
  PairSolver pairs;
  std::vector<TouchSimulation> alone;  // per thread: of points that touch no others
  SurfaceSolver surface;
  // Points may have been edited.
  void begin_frame() {
    pairs.begin_frame();
    surface.begin_frame();
  }
  bool has_too_many_pairs() const { return pairs.has_failed() || surface.has_failed(); }
};

// Corrects the step of h that led from (before.x, before.v) to (motion.x, motion.v). A point's path within the step is the parabola through
// both positions under the step's mean acceleration; its impacts are solved for on it. What it touches without bouncing exerts constant
// forces, with friction (solve_resting_points, TouchSimulation). Flights, impacts and slides on planes are exact under constant
// acceleration, slides on balls second order. Nothing passes through at any speed; a point that starts inside is moved to the surface, as
// work of colliders; resting points keep their bits. All of this is relative to moving colliders, whose positions at both ends of the step
// are exact, with parabolas between them. Points that may touch others within the step are left to the PairSolver. Returns whether anything
// touched.
//
// `before` says whether the strain limit has changed the velocities of `motion`.
bool resolve_contacts(const Plan& plan, ContactWorkspace& before, Motion& motion, double h);

// The part of it about one-way planes (Plan::one_way), walls as those of XSpringies 1.12. Points that cross them from the free side in this
// substep rebound: the restitution multiplies the normal velocity and the tangential one. Sticky planes take strength x 1 s / mass off the
// rebound; a point that would not leave stops, and is held while forces pull at it or press with less than the strength. Points that start
// behind a plane are free. Adds the work [J]. Returns whether any point was moved.
bool rebound_from_walls(const Plan& plan, ContactWorkspace& before, double h, Motion& motion, double& work);

// Imposes the strain limit (spring_limits.h) at the end of a substep, before contact. Returns whether it moved points.
bool limit_strain(const Plan& plan, ContactWorkspace& before, Motion& motion);

}  // namespace hooke
