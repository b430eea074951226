// The search for a cheaper method: what it finds is no less accurate.
#include <gtest/gtest.h>

#include "sim/frame_error.h"
#include "study/cheaper_method.h"
#include "support/nets.h"

namespace hooke {
namespace {

TEST(CheaperMethod, IsNoLessAccurateThanThePresentOne) {
  Trial trial = net(8, 1e4, 0.0);
  trial.run(default_integrator(), 0.2, 2000);
  // far too many steps of a method of low order
  const Settings wasteful{.integrator = find_integrator("implicit_euler"), .substeps = 64};
  const auto cheaper = find_cheaper_method(trial.system, trial.state, wasteful, std::atomic<bool>(false));
  ASSERT_TRUE(cheaper);
  EXPECT_LT(cheaper->cost, 1.0 / worthwhile_saving);
  const Settings proposed{.integrator = cheaper->integrator, .substeps = cheaper->substeps};
  EXPECT_LT(estimate_frame_error(trial.system, proposed, trial.state), 1.5 * estimate_frame_error(trial.system, wasteful, trial.state));
}

TEST(CheaperMethod, ThereIsNoneWhereTheErrorIsRoundingError) {
  Trial trial;
  trial.add(Vec3(0.0));
  EXPECT_FALSE(find_cheaper_method(trial.system, trial.state, {}, std::atomic<bool>(false)));
}

}  // namespace
}  // namespace hooke
