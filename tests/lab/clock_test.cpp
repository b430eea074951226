// The clock of the laboratory, and the return to the start.
#include "lab/lab.h"

#include <gtest/gtest.h>

#include "scene/parameters.h"
#include "sim/model/hash.h"
#include "support/apply_now.h"
#include "support/small_net.h"

namespace hooke {
namespace {

TEST(Clock, StepsTheFramesThatTheElapsedTimeRequires) {
  Lab lab(small_net());
  lab.submit(SetRunning{true});
  for (int i = 0; i < 100; ++i) lab.advance(0.01, [] { return true; });
  EXPECT_NEAR(lab.scene().state.time, 1.0, 1.0 / 60.0 + 1e-9);
  lab.submit(Command(SetParameter{find_parameter("speed"), 0.5}));
  const double before = lab.scene().state.time;
  for (int i = 0; i < 100; ++i) lab.advance(0.01, [] { return true; });
  EXPECT_NEAR(lab.scene().state.time - before, 0.5, 1.0 / 60.0 + 1e-9);
}

TEST(Clock, ResumesAfterALongSleepWithoutAJump) {
  Lab lab(small_net());
  lab.submit(SetRunning{true});
  lab.advance(10.0, [] { return true; });
  EXPECT_LE(lab.scene().state.time, 0.26);
}

TEST(Clock, SlowsDownInsteadOfAccumulatingDelay) {
  Lab lab(small_net());
  lab.submit(SetRunning{true});
  // there is time for only one substep per call, and a frame has 20
  for (int i = 0; i < 200; ++i) lab.advance(1.0 / 60.0, [] { return false; });
  EXPECT_NEAR(lab.scene().state.time * 60.0, 10.0, 1.0);
  EXPECT_NEAR(lab.status()->run.speed, 0.05, 0.05);
  // once there is enough time again, missed frames are not caught up
  const double before = lab.scene().state.time;
  lab.advance(1.0 / 60.0, [] { return true; });
  EXPECT_LE(lab.scene().state.time - before, 3.0 / 60.0 + 1e-9);
}

TEST(Clock, AnInterruptedFrameGivesTheSameBits) {
  Lab whole(small_net()), cut(small_net());
  for (int i = 0; i < 10; ++i) whole.step();
  cut.submit(SetRunning{true});
  int substeps = 0;
  while (cut.status()->run.frames < 10) cut.advance(0.02, [&] { return ++substeps % 3 != 0; });
  EXPECT_EQ(hash_state(cut.scene().state), hash_state(whole.scene().state));
}

TEST(Clock, StepsOneFrameWhenPausedAndReportsIt) {
  Lab lab(small_net());
  lab.submit(StepOnce{});
  apply_now(lab);
  EXPECT_NEAR(lab.scene().state.time, 1.0 / 60.0, 1e-15);
  EXPECT_FALSE(lab.status()->run.running);
}

TEST(Start, KeepsTheCurrentMethodOnRestart) {
  Lab lab(small_net());
  Content start = content_of(lab.scene());
  lab.step();
  lab.submit(Command(SetParameter{find_parameter("substeps"), 33}));
  lab.submit(Command(Remove{.points = {lab.scene().system.points()[3].id}}));
  for (int i = 0; i < 30; ++i) lab.step();
  const Content run = content_of(lab.scene());
  lab.submit(GoToStart{});
  apply_now(lab);
  start.position.erase(start.position.begin() + 3);
  EXPECT_EQ(lab.scene().system, run.system);
  EXPECT_EQ(lab.scene().state.position, start.position);
  EXPECT_EQ(lab.scene().state.time, 0.0);
  EXPECT_EQ(lab.scene().settings.substeps, 33);
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(content_of(lab.scene()), run);
}

TEST(Start, IsTheStateBeforeTheFirstRunHoweverOftenItIsSaved) {
  Lab lab(small_net());
  lab.submit(Command(Remove{.points = {lab.scene().system.points()[3].id}}));
  apply_now(lab);
  const Content built = content_of(lab.scene());
  for (int i = 0; i < 10; ++i) lab.step();
  lab.submit(MarkSaved{});
  for (int i = 0; i < 10; ++i) lab.step();
  lab.submit(GoToStart{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().system, built.system);
  EXPECT_EQ(lab.scene().state.position, built.position);
  EXPECT_EQ(lab.scene().state.time, 0.0);
}

}  // namespace
}  // namespace hooke
