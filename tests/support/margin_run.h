// Steps with contact of faces and springs whose pairs are searched with some margin.
#pragma once

#include <utility>

#include "sim/contact/surface/surface_solver.h"
#include "support/test_sim.h"

namespace hooke {

// Positions and velocities after this many substeps of a sixtieth of 1/60 s of the default method, and how often pairs were searched.
inline std::pair<Field, Field> run_with_margin(const TestSim& sim, double margin, int substeps, long& searches) {
  const Integrator& method = default_integrator();
  Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  Workspace work;
  const double h = 1.0 / 3600.0;
  method.prepare(plan, h, motion, work);
  SurfaceSolver solver(margin);
  solver.begin_frame();
  for (int i = 0; i < substeps; ++i) {
    const Field x = motion.x, v = motion.v;
    method.step(plan, motion, work, h);
    const Field free_v = motion.v;
    if (solver.resolve(plan, {}, {}, {x, v, free_v, method.velocity_lag}, h, motion)) motion.acceleration_is_current = false;
  }
  searches = solver.searches();
  return {motion.x, motion.v};
}

}  // namespace hooke
