// Contact of faces on several threads: the same bits. With HOOKE_PRINT set, how long frames take on one and two of them.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "base/threads/thread_team.h"
#include "sim/model/hash.h"
#include "support/folds.h"

namespace hooke {
namespace {

double real_ms() { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct FoldsOnThreads {
  std::uint64_t hash = 0;
  double work = 0.0;  // [J]
  long tests = 0, impulses = 0;
  bool has_failed = false;
  bool operator==(const FoldsOnThreads&) const = default;
};

// With the mean time of a frame in each third of them, if asked for [ms].
FoldsOnThreads fold_on_threads(TestSim sim, int frames, int substeps, int threads, std::array<double, 3>* ms = nullptr) {
  Plan plan = make_plan(sim.system);
  if (threads > 1) plan.execution.team = std::make_shared<ThreadTeam>(threads, WhenLate::Wait);
  Frame frame;
  FoldsOnThreads outcome;
  for (int i = 0; i < frames; ++i) {
    const double start = real_ms();
    frame.begin(plan, sim.system, {.integrator = &default_integrator(), .substeps = substeps}, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, sim.state);
    if (ms != nullptr) (*ms)[static_cast<std::size_t>(3 * i / frames)] += (real_ms() - start) / (frames / 3);
    outcome.work += frame.motion().energy[EnergyCause::Contact] + frame.motion().energy[EnergyCause::Hand];
    outcome.tests += frame.motion().counts.contact_tests;
    outcome.impulses += frame.motion().counts.contact_impulses;
  }
  outcome.hash = hash_state(sim.state);
  outcome.has_failed = frame.failure() != StepFailure::None;
  return outcome;
}

FoldsOnThreads expect_same_folds(const TestSim& sim, int frames, int substeps, std::initializer_list<int> on = {2, 3}) {
  const FoldsOnThreads one = fold_on_threads(sim, frames, substeps, 1);
  for (const int threads : on) EXPECT_EQ(fold_on_threads(sim, frames, substeps, threads), one) << threads;
  return one;
}

// The tree of each has 256 leaves, and so as many sections as threads can use.
TEST(SurfaceThreads, FindTheSameContacts) {
  TestSim sim = colliding_sheets(24);
  folds::touch(sim);
  EXPECT_GT(expect_same_folds(sim, 1, 40, {2, 3, 16}).impulses, 1000);
  sim = pulled_sheet(32, 10.0);
  folds::touch(sim);
  EXPECT_GT(expect_same_folds(sim, 4, 30).impulses, 100);
}

// Sheets so close to each other that each touches all others: more pairs than fit.
TEST(SurfaceThreads, GiveUpWhereOneDoes) {
  TestSim sim;
  for (int layer = 0; layer < 60; ++layer)
    folds::add_sheet(
        sim, 8, [&](double u, double v) { return Vec3(u, 1e-4 * layer, v); }, folds::at_rest);
  sim.system.contact = {.faces = true, .thickness = 0.07};
  EXPECT_TRUE(expect_same_folds(sim, 1, 1).has_failed);
}

// Scenes with k = 1000 N/m: with HOOKE_PRINT for a second, otherwise for some frames.
TEST(SurfaceThreads, FoldClothsToTheSameBits) {
  const bool prints = std::getenv("HOOKE_PRINT") != nullptr;
  struct Case {
    const char* name;
    TestSim sim;
    int substeps, frames;
  };
  for (auto& [name, sim, substeps, frames] :
       {Case{"cloth 32, dragged", pulled_sheet(32, 3.0), 52, 3}, Case{"cloth 64, falling", dropped_sheet(64), 104, 0}}) {
    if (!prints && frames == 0) continue;
    TestSim stiff = sim;
    for (Index s = 0; s < stiff.system.spring_count(); ++s) stiff.system.spring(s)->stiffness *= 1000.0 / 300.0;
    folds::touch(stiff);
    std::array<FoldsOnThreads, 2> outcome;
    for (const int threads : {1, 2}) {
      std::array<double, 3> ms{};
      outcome[static_cast<std::size_t>(threads - 1)] = fold_on_threads(stiff, prints ? 60 : frames, substeps, threads, &ms);
      if (!prints) continue;
      const double ns = 1e6 / (static_cast<double>(stiff.system.spring_count()) * substeps);
      std::printf(
          "%s, threads: %d; ms per frame in each third of a second: %.1f, %.1f, %.1f; ns per spring and substep: %.0f, %.0f, %.0f\n", name,
          threads, ms[0], ms[1], ms[2], ns * ms[0], ns * ms[1], ns * ms[2]);
    }
    EXPECT_EQ(outcome[0], outcome[1]) << name;
    EXPECT_GT(outcome[0].tests, 0) << name;
  }
}

}  // namespace
}  // namespace hooke
