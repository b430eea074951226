// A sheet that crumples into folds: what contact costs there, and that nothing passes through anything.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "support/crossings.h"
#include "support/upright_sheet.h"

namespace hooke {
namespace {

struct Crumpled {
  double cpu = 0.0;  // [s]
  long crossings = 0, touched_frames = 0;
  double energy = 0.0;  // [J], gained by the method
};

Crumpled crumple(const Integrator& method, int n, double seconds, bool touches, bool counts) {
  TestSim sim = upright_sheet(n, touches);
  const CrossingCounter counter(sim.system);
  Plan plan = make_plan(sim.system);
  Frame frame;
  Crumpled result;
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  for (int i = 0; i < static_cast<int>(60.0 * seconds); ++i) {
    const double start = now();
    frame.begin(plan, sim.system, {.integrator = &method, .substeps = static_cast<int>(4.5 * n)}, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, sim.state);
    result.cpu += now() - start;
    if (counts) result.crossings = std::max(result.crossings, counter.count(sim.state.position));
  }
  return result;
}

TEST(Folds, AreFreeOfCrossingsWithEveryMethod) {
  for (const Integrator& method : integrators()) {
    if (!method.for_production) continue;
    const Crumpled crumpled = crumple(method, 17, 0.6, true, true);
    EXPECT_EQ(crumpled.crossings, 0) << method.id;
  }
}

// The ratio of CPU times is printed, not tested: it depends on the machine.
TEST(Folds, OfTheDefaultMethodAreFreeOfCrossings) {
  const bool prints = std::getenv("HOOKE_PRINT") != nullptr;
  for (const auto& [n, seconds] : {std::pair(33, prints ? 1.2 : 0.4), {65, prints ? 0.6 : 0.05}}) {
    const Crumpled crumpled = crumple(default_integrator(), n, seconds, true, true);
    EXPECT_EQ(crumpled.crossings, 0) << n;
    if (!prints) continue;
    const Crumpled free = crumple(default_integrator(), n, seconds, false, false);
    std::printf("%d x %d: %.3g s with contact, %.3g s without: %.3g times\n", n, n, crumpled.cpu, free.cpu, crumpled.cpu / free.cpu);
  }
}

}  // namespace
}  // namespace hooke
