// Jobs that threads compute together.
#include "base/threads/thread_team.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <vector>

namespace hooke {
namespace {

TEST(ThreadTeam, ComputesEachPartOnce) {
  for (const int threads : {1, 2, 3, 16}) {
    ThreadTeam team(threads);
    ASSERT_EQ(team.size(), threads);
    std::vector<int> count(static_cast<std::size_t>(threads));
    const ThreadTeam::Turn turn(&team);
    ASSERT_TRUE(turn);
    int expected = 0;
    for (int job = 0; job < 50; ++job) {
      const int parts = 1 + job % threads;
      turn.run(parts, [&](int part) { ++count[static_cast<std::size_t>(part)]; });
      expected += parts;
      EXPECT_EQ(std::accumulate(count.begin(), count.end(), 0), expected);
    }
  }
}

TEST(ThreadTeam, ComputesOnAsManyThreadsAsThereAreParts) {
  ThreadTeam team(4);
  std::vector<std::thread::id> thread(4);
  const ThreadTeam::Turn turn(&team);
  turn.run(4, [&](int part) { thread[static_cast<std::size_t>(part)] = std::this_thread::get_id(); });
  EXPECT_EQ(thread[0], std::this_thread::get_id());
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(thread[i], thread[j]);
}

TEST(ThreadTeam, WakesUpForTheNextJob) {
  ThreadTeam team(2);
  const ThreadTeam::Turn turn(&team);
  int jobs = 0;
  for (int i = 0; i < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    turn.run(2, [&](int part) {
      if (part == 1) ++jobs;
    });
  }
  EXPECT_EQ(jobs, 5);
}

TEST(ThreadTeam, WaitsForALongPart) {
  ThreadTeam team(2);
  const ThreadTeam::Turn turn(&team);
  bool is_done = false;
  turn.run(2, [&](int part) {
    if (part == 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    is_done = true;
  });
  EXPECT_TRUE(is_done);
}

TEST(ThreadTeam, GivesOneTurnAtATime) {
  ThreadTeam team(2);
  bool second = true, third = false;
  {
    const ThreadTeam::Turn turn(&team);
    std::jthread([&] { second = static_cast<bool>(ThreadTeam::Turn(&team)); }).join();
  }
  std::jthread([&] { third = static_cast<bool>(ThreadTeam::Turn(&team)); }).join();
  EXPECT_FALSE(second);
  EXPECT_TRUE(third);
  EXPECT_FALSE(ThreadTeam::Turn(nullptr));
}

TEST(ThreadTeam, ComputesAloneAfterOthersWereLateTwice) {
  for (const WhenLate when_late : {WhenLate::ComputeAlone, WhenLate::Wait}) {
    ThreadTeam team(2, when_late);
    const auto be_late = [](int part) {
      if (part == 1) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    };
    for (int job = 0; job < 2; ++job) {
      const ThreadTeam::Turn turn(&team);
      ASSERT_TRUE(turn);
      turn.run(2, be_late);
    }
    EXPECT_EQ(static_cast<bool>(ThreadTeam::Turn(&team)), when_late == WhenLate::Wait);
    bool has_turn = false;
    for (int job = 0; job < 3000; ++job) has_turn = static_cast<bool>(ThreadTeam::Turn(&team));
    EXPECT_TRUE(has_turn);
  }
}

TEST(ThreadTeam, KeepsSharedMemoryUntilMoreIsNeeded) {
  ThreadTeam team(2);
  const ThreadTeam::Turn turn(&team);
  double* const memory = turn.scratch(100);
  EXPECT_EQ(turn.scratch(10), memory);
  EXPECT_EQ(turn.scratch(100), memory);
}

}  // namespace
}  // namespace hooke
