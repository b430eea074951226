// The timeline: the times that can be returned to, and that a run continues from there as before.
#include "lab/timeline.h"

#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/model/hash.h"
#include "support/apply_now.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

void step(Lab& lab, int frames) {
  for (int frame = 0; frame < frames; ++frame) lab.step();
}

// Applies queued commands without advancing time.
void settle(Lab& lab) { apply_now(lab); }

std::uint64_t hash_of(const Lab& lab) { return hash_state(lab.scene().state); }

TEST(Timeline, StepsBackFrameByFrameToTheStart) {
  Lab lab = lab_on("two_masses");
  std::vector<std::uint64_t> hashes{hash_of(lab)};
  for (int frame = 0; frame < 10; ++frame) {
    lab.step();
    hashes.push_back(hash_of(lab));
  }
  for (int frame = 9; frame >= 0; --frame) {
    lab.submit(StepBack{});
    settle(lab);
    EXPECT_EQ(hash_of(lab), hashes[static_cast<std::size_t>(frame)]) << frame;
  }
  lab.submit(StepBack{});
  settle(lab);
  EXPECT_EQ(hash_of(lab), hashes[0]);
}

TEST(Timeline, ContinuesFromThePastWithTheSameBits) {
  Lab lab = lab_on("two_masses");
  step(lab, 20);
  const std::uint64_t end = hash_of(lab);
  lab.submit(GoToTime{0.1});
  settle(lab);
  EXPECT_NEAR(lab.scene().state.time, 0.1, 1e-9);
  const int left = 20 - static_cast<int>(std::lround(lab.scene().state.time * lab.scene().settings.frame_rate));
  step(lab, left);
  EXPECT_EQ(hash_of(lab), end);
}

TEST(Timeline, KeepsTheFutureUntilTheRunContinuesDifferently) {
  Lab lab = lab_on("two_masses");
  step(lab, 20);
  const double last = lab.scene().state.time;
  lab.submit(GoToTime{0.1});
  settle(lab);
  EXPECT_EQ(lab.status()->timeline.end, last);
  lab.submit(GoToTime{last});
  settle(lab);
  EXPECT_EQ(lab.scene().state.time, last);
  lab.submit(GoToTime{0.1});
  lab.submit(SetParameter{find_parameter("gravity"), 1.0});
  step(lab, 1);
  lab.publish();
  EXPECT_EQ(lab.status()->timeline.end, lab.scene().state.time);
}

TEST(Timeline, GoingBackChangesNoParameterAndCanBeUndone) {
  Lab lab = lab_on("two_masses");
  step(lab, 10);
  lab.submit(SetParameter{find_parameter("drag"), 0.5});
  step(lab, 10);
  const std::uint64_t before = hash_of(lab);
  // a drag of the scrubber is one step
  lab.submit(GoToTime{0.2}, 7);
  lab.submit(GoToTime{0.1}, 7);
  settle(lab);
  EXPECT_EQ(lab.scene().system.drag, 0.5);
  EXPECT_EQ(lab.status()->history.undo_name, "go to 0.1 s");
  lab.submit(Undo{});
  settle(lab);
  EXPECT_EQ(hash_of(lab), before);
  EXPECT_EQ(lab.status()->history.undo_name.substr(0, 3), "set");
}

TEST(Timeline, EndsWherePointsWereAdded) {
  Lab lab = lab_on("two_masses");
  step(lab, 10);
  lab.submit(Insert{{{no_index, {.id = lab.new_point_id()}, Vec3(0.0), Vec3(0.0)}}, {}, {}});
  settle(lab);
  EXPECT_EQ(lab.status()->timeline.start, lab.status()->timeline.end);
  lab.submit(StepBack{});
  settle(lab);
  EXPECT_EQ(lab.scene().state.position.size(), lab.scene().system.points().size());
  EXPECT_GT(lab.scene().state.time, 0.1);
}

TEST(Timeline, DiscardsTheOldestFramesBeyondItsLimits) {
  Timeline timeline;
  State small;
  for (int i = 0; i < 3000; ++i) {
    small.time = i;
    timeline.record(small);
  }
  EXPECT_EQ(timeline.count(), Timeline::max_states);
  EXPECT_EQ(timeline.first_time(), 1000.0);
  EXPECT_EQ(timeline.find(1500.5), 500u);
  EXPECT_EQ(timeline.find(0.0), 0u);

  State large;
  large.position.assign(100'000, Vec3(0.0));
  large.velocity = large.position;
  for (int i = 0; i < 40; ++i) {
    large.time = 10000 + i;
    timeline.record(large);
  }
  EXPECT_LE(timeline.bytes(), Timeline::max_bytes);
  EXPECT_EQ(timeline.last_time(), 10039.0);
  timeline.clear();
  EXPECT_EQ(timeline.bytes(), 0u);
}

TEST(RunTo, StopsAtTheRequestedTimeRunningAtFullSpeed) {
  Lab lab = lab_on("two_masses");
  lab.submit(RunTo{5.0});
  lab.advance(1e-3, [] { return true; });
  EXPECT_NEAR(lab.scene().state.time, 5.0, 0.5 / lab.scene().settings.frame_rate);
  EXPECT_FALSE(lab.status()->run.running);
  EXPECT_EQ(lab.status()->run.to, 0.0);
}

TEST(RunTo, CanBeStoppedMidway) {
  Lab lab = lab_on("two_masses");
  lab.submit(RunTo{1e6});
  int calls = 0;
  lab.advance(1e-3, [&] { return ++calls < 100; });
  EXPECT_TRUE(lab.status()->run.running);
  EXPECT_EQ(lab.status()->run.to, 1e6);
  lab.submit(SetRunning{false});
  settle(lab);
  EXPECT_FALSE(lab.status()->run.running);
  EXPECT_LT(lab.scene().state.time, 100.0);
}

}  // namespace
}  // namespace hooke
