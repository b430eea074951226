// The laboratory on its own thread: the same bits, and responses at any time.
#include "lab/lab_thread.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/model/hash.h"
#include "support/sanitizer_slowdown.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

using namespace std::chrono_literals;

// A rope of `count` points that hangs from its first point.
Scene rope(int count) {
  TestSim sim;
  std::vector<PointId> points;
  for (int i = 0; i < count; ++i) points.push_back(i == 0 ? sim.nail(Vec3(0.0)) : sim.add({0.01 * i, 0.0, 0.0}, 0.01));
  for (int i = 1; i < count; ++i) sim.join(points[i - 1], points[i], 1000.0, 0.01);
  Scene scene;
  scene.system = sim.system;
  scene.state = sim.state;
  return scene;
}

template <class Condition>
bool wait_for(Condition condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

TEST(LabThread, GivesTheSameBitsAsWithoutAThread) {
  LabThread threaded(rope(20));
  threaded.submit(SetRunning{true});
  ASSERT_TRUE(wait_for([&] { return threaded.status()->run.frames >= 30; }));
  threaded.submit(SetRunning{false});
  const auto scene = threaded.copy_scene(LabThread::Moment::Present).get();

  Lab lab(rope(20));
  while (lab.scene().state.time < scene->state.time - 1e-9) lab.step();
  EXPECT_EQ(hash_state(lab.scene().state), hash_state(scene->state));
}

TEST(LabThread, AppliesCommandsInOrder) {
  LabThread lab(rope(3));
  const PointId point = lab.new_point_id();
  lab.submit(Command(Insert{.points = {{.point = {.id = point}, .position = {0.0, 1.0, 0.0}}}}));
  lab.submit(Command(SetNailed{{{point, true}}}));
  lab.submit(Undo{});
  const auto scene = lab.copy_scene(LabThread::Moment::Present).get();
  ASSERT_EQ(scene->system.point_count(), 4);
  EXPECT_FALSE(scene->system.points()[3].nailed);
  EXPECT_NE(lab.new_point_id(), point);
}

TEST(LabThread, RespondsWhileAFrameTakesLong) {
  Scene scene = rope(2000);
  scene.settings.substeps = 200000;  // seconds per frame
  LabThread lab(std::move(scene));
  lab.submit(SetRunning{true});
  ASSERT_TRUE(wait_for([&] { return lab.status()->run.running; }));
  lab.submit(Command(SetParameter{find_parameter("drag"), 5.0}));
  lab.submit(SetRunning{false});
  EXPECT_TRUE(wait_for([&] { return !lab.status()->run.running && lab.status()->snapshot->system->drag == 5.0; }));
  EXPECT_EQ(lab.status()->run.frames, 0);
}

TEST(LabThread, ComputesFramesDuringAStreamOfEdits) {
  Scene scene = rope(2000);
  scene.settings.substeps = 20;
  LabThread lab(std::move(scene));
  lab.submit(SetRunning{true});
  const auto end = std::chrono::steady_clock::now() + 30s;
  for (int i = 0; lab.status()->run.frames < 1 && std::chrono::steady_clock::now() < end; ++i) {
    lab.submit(Command(SetParameter{find_parameter("drag"), 1.0 + i % 2}));
    std::this_thread::sleep_for(20us * sanitizer_slowdown);  // less than an edit takes, so that there is always another one
  }
  EXPECT_GE(lab.status()->run.frames, 1);
}

TEST(LabThread, IsIdleWhilePausedWithoutCatchingUpAfterwards) {
  LabThread lab(rope(5));
  const auto status = lab.status();
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(lab.status(), status);  // nothing published, because nothing ran

  lab.submit(SetRunning{true});
  ASSERT_TRUE(wait_for([&] { return lab.status()->run.running; }));
  EXPECT_LE(lab.status()->snapshot->state.time, 0.1);  // the pause was not caught up
}

TEST(LabThread, StopsAtOnceInTheMiddleOfAFrame) {
  Scene scene = rope(2000);
  scene.settings.substeps = 1000000;
  const auto start = std::chrono::steady_clock::now();
  {
    LabThread lab(std::move(scene));
    lab.submit(SetRunning{true});
    wait_for([&] { return lab.status()->run.running; });
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10s);
}

}  // namespace
}  // namespace hooke
