// Surfaces filled with gas that tear.
#include <gtest/gtest.h>

#include "lab/lab.h"
#include "support/gas_bodies.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

// A ball whose first spring breaks as the gas stretches it.
Scene weak_ball() {
  TestSim sim = gas_ball(1, 50.0, {.pressure = 40.0});
  sim.system.spring(0)->break_strain = 0.1;
  Scene scene;
  scene.system = sim.system;
  scene.state = sim.state;
  scene.settings.substeps = 20;
  initialize_ledger(scene.system, scene.state);
  return scene;
}

TEST(GasRelease, ATornSurfaceLosesItsGasAndReportsIt) {
  Lab lab(weak_ball());
  ASSERT_EQ(lab.plan().force_data.enclosures.enclosures.size(), 1u);
  while (lab.gas_releases().empty() && lab.scene().state.time < 1.0) run(lab, 1);
  EXPECT_EQ(lab.scene().system.springs().size(), weak_ball().system.springs().size() - 1);
  EXPECT_TRUE(lab.plan().force_data.enclosures.empty());
  const std::vector<double> times = lab.gas_releases();
  ASSERT_EQ(times.size(), 1u);
  EXPECT_EQ(times[0], lab.scene().state.time);
  const double work = lab.last_frame().motion().force_work;
  run(lab, 1);
  EXPECT_GT(work, 0.0);
  EXPECT_EQ(lab.last_frame().motion().force_work, 0.0);
  EXPECT_EQ(lab.gas_releases(), times) << "once";
  lab.publish();
  EXPECT_EQ(lab.status()->run.gas_releases, 1u);

  // undoing the tear closes the surface again
  submit_and_apply(lab, Undo{});
  EXPECT_EQ(lab.plan().force_data.enclosures.enclosures.size(), 1u);
  submit_and_apply(lab, GoToStart{});
  EXPECT_TRUE(lab.gas_releases().empty());
}

}  // namespace
}  // namespace hooke
