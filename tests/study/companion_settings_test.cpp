// Ghosts: the run beside a run that counts as exact.
#include "study/companion_settings.h"

#include <gtest/gtest.h>

#include "sim/control/frame_error.h"
#include "sim/methods/integrator.h"
#include "support/nets.h"

namespace hooke {
namespace {

TEST(CompanionSettings, TheReferenceIsNearTheConvergedSolution) {
  const TestSim sim = net(5, 1e3, 0.0);
  const Companion reference = reference_companion(sim.state, {});
  EXPECT_TRUE(reference.name.starts_with("Reference (dop853, ")) << reference.name;
  TestSim run = sim, converged = sim;
  for (int frame = 0; frame < 30; ++frame) {
    run.run(*reference.settings.integrator, 1.0 / 60.0, reference.settings.substeps, *reference.settings.tolerance);
    converged.run(*find_integrator("blanes_moan4"), 1.0 / 60.0, 200);
  }
  EXPECT_LT(weighted_distance(run.system, run.state.position, converged.state.position, 1.0).rms, 1e-6);
}

}  // namespace
}  // namespace hooke
