// The comparison of methods on a scene: against a reference that two methods agree on, for as long as the motion can be predicted.
#include "study/compare_methods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/control/frame_error.h"
#include "support/accuracy_scenes.h"
#include "support/convergence.h"

namespace hooke {
namespace {

constexpr Effort quick{.repeats = 1, .run_seconds = 0.01, .reference_seconds = 0.3, .finest_error = 1e-8};

TEST(CompareMethods, TheErrorOfARowIsThatOfARun) {
  TestSim sim = net(4, 1e2, 0.0);
  sim.state.time = 3.0;
  const MethodComparison comparison = compare_methods(sim.system, sim.state, 0.5, quick, [](double) { return true; });
  EXPECT_EQ(comparison.note, "");
  int compared = 0;
  for (const Row& row : comparison.record.rows) {
    if (row.method != "velocity_verlet" || row.status != status::ok) continue;
    TestSim exact = sim, run = sim;
    exact.run(*find_integrator("blanes_moan4"), 0.5, 2000);
    run.run(default_integrator(), 0.5, static_cast<int>(std::lround(0.5 / *row.step)));
    // that of the worst of four moments
    const double at_end = distance(run.state, exact.state);
    EXPECT_GT(*row.error, 0.99 * at_end) << row.setting;
    EXPECT_LT(*row.error, 5.0 * at_end) << row.setting;
    ++compared;
  }
  EXPECT_GE(compared, 2);
  std::set<std::string> methods;
  for (const Row& row : comparison.record.rows) methods.insert(row.method);
  EXPECT_EQ(methods.size(), integrators().size());
}

TEST(CompareMethods, AChaoticMotionIsComparedForAShorterTimeAndThisIsReported) {
  const TestSim sim = curtain(6, 1e4, 0.0);
  const MethodComparison comparison = compare_methods(sim.system, sim.state, 2.0, quick, [](double) { return true; });
  EXPECT_LT(comparison.record.seconds, 2.0);
  EXPECT_NE(comparison.note.find("cannot be predicted"), std::string::npos) << comparison.note;
}

TEST(CompareMethods, CanBeStopped) {
  const TestSim sim = net(4, 1e2, 0.0);
  int calls = 0;
  const MethodComparison comparison = compare_methods(sim.system, sim.state, 1.0, quick, [&](double) { return ++calls < 3; });
  EXPECT_EQ(comparison.note, "Stopped.");
  EXPECT_LT(calls, 100);
}

TEST(CompareMethods, TheSubstepsOfARowTakeAtMostItsStep) {
  EXPECT_EQ(substeps_of({.step = 1.0 / 120.0}, 60.0), 2);
  EXPECT_EQ(substeps_of({.step = 1.0 / 130.0}, 60.0), 3);
  EXPECT_EQ(substeps_of({.step = 1.0}, 60.0), 1);
  EXPECT_EQ(substeps_of({.tolerance = 1e-6}, 60.0), std::nullopt);
}

}  // namespace
}  // namespace hooke
