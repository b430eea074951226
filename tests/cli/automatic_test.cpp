// The method `auto` on the command line.
#include <gtest/gtest.h>

#include <fstream>

#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

// Without a named method, a tolerance selects auto; the summary says what it chose; the same bits every time.
TEST(AutomaticMethod, IsSelectedByATolerance) {
  const Outcome first = run_headless("run cloth --seconds 0.5 --tolerance 1e-3"),
                again = run_headless("run cloth --seconds 0.5 --integrator auto");
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.out.find("auto, tolerance 0.001 m/s"), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("last choice: "), std::string::npos) << first.out;
  EXPECT_EQ(first.out.substr(first.out.find("hash ")), again.out.substr(again.out.find("hash ")));
}

// A tolerance that no method can meet is not passed over in silence.
TEST(AutomaticMethod, SaysWhereTheToleranceIsNotMet) {
  const Outcome run = run_headless("run two_masses --seconds 0.01 --tolerance 1e-30");
  EXPECT_EQ(run.code, 4) << run.out;
  EXPECT_NE(run.err.find("the tolerance was not met in 1 of 1 frames"), std::string::npos) << run.err;
}

// A setting that the method does not use is an error on the command line.
TEST(AutomaticMethod, AToleranceSetWithoutAMethodThatUsesItIsRefused) {
  const Outcome tolerance = run_headless("run cloth --seconds 0.1 --set tolerance=1e-4");
  EXPECT_EQ(tolerance.code, 2) << tolerance.out;
  EXPECT_NE(tolerance.err.find("--set tolerance=1e-04: requires an adaptive method: dop853, auto"), std::string::npos) << tolerance.err;
  const Outcome budget = run_headless("run cloth --seconds 0.1 --set budget=2 --integrator dop853");
  EXPECT_EQ(budget.code, 2) << budget.out;
  EXPECT_NE(budget.err.find("--set budget=2: requires the method auto"), std::string::npos) << budget.err;
  const Outcome automatic = run_headless("run two_masses --seconds 0.1 --set tolerance=1e-4 --set budget=2 --integrator auto");
  EXPECT_EQ(automatic.code, 0) << automatic.err;
  EXPECT_NE(automatic.out.find("auto, tolerance 1e-04 m/s"), std::string::npos) << automatic.out;
}

}  // namespace
}  // namespace hooke
