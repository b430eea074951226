// Threads and precision of a laboratory.
#include <gtest/gtest.h>

#include <memory>

#include "base/threads/thread_team.h"
#include "sim/forces/single_precision.h"
#include "sim/model/hash.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

// With so short a step that its error in double precision is below that of rounding in single precision.
Scene short_step_sheet(int points) {
  const std::string n = std::to_string(points);
  return parse(
      R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0.3], "points": [)" + n +
      ", " + n + R"(], "mass": 1, "stiffness": 100, "nail": ["top"]}], "simulation": {"substeps": 400}})");
}

Accuracy accuracy_after(Execution execution) {
  Lab lab(short_step_sheet(12), KeepStart::No);
  lab.set_execution(std::move(execution));
  lab.submit(SetAccuracy{AccuracyMode::Full});
  run(lab, 6);
  return lab.accuracy();
}

TEST(Execution, ErrorsInSinglePrecisionIncludeRounding) {
  const Accuracy exact = accuracy_after({}), rounded = accuracy_after({.single = std::make_shared<SinglePrecision>()});
  ASSERT_TRUE(exact.frame.value && rounded.frame.value && exact.accumulated.value && rounded.accumulated.value);
  EXPECT_GT(*rounded.frame.value, 3.0 * *exact.frame.value);
  EXPECT_GT(*rounded.accumulated.value, 3.0 * *exact.accumulated.value);
  EXPECT_LT(*rounded.accumulated.value, 1e-5);
}

std::uint64_t hash_after_edit(Execution execution) {
  Lab lab(short_step_sheet(48));
  lab.set_execution(std::move(execution));
  run(lab, 1);
  lab.submit(Remove{.points = {lab.scene().system.points()[1000].id}});
  run(lab, 1);
  return hash_state(lab.scene().state);
}

TEST(Execution, AppliesAfterEdits) {
  const std::uint64_t one = hash_after_edit({});
  EXPECT_EQ(hash_after_edit({.team = std::make_shared<ThreadTeam>(2, WhenLate::Wait)}), one);
  EXPECT_NE(hash_after_edit({.single = std::make_shared<SinglePrecision>()}), one);
}

TEST(Execution, AppliesToThePlanOfAnEditedScene) {
  Lab lab(short_step_sheet(12));
  const auto team = std::make_shared<ThreadTeam>(2);
  lab.set_execution({.team = team});
  EXPECT_EQ(lab.plan().execution.team, team);
  lab.submit(Remove{.points = {lab.scene().system.points()[100].id}});
  apply_now(lab);
  EXPECT_EQ(lab.plan().points, 143);
  EXPECT_EQ(lab.plan().execution.team, team);
}

}  // namespace
}  // namespace hooke
