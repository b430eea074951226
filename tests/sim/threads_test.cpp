// Any number of threads computes the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>

#include "base/threads/thread_team.h"
#include "sim/forces/bands.h"
#include "sim/forces/force_terms.h"
#include "sim/forces/terms/rows.h"
#include "sim/methods/rows.h"
#include "sim/model/hash.h"
#include "support/nets.h"

namespace hooke {
namespace {

constexpr int points_of_side = 129;  // rows that no number of threads divides, and columns that no number of lanes divides

struct OutcomeOnThreads {
  std::uint64_t hash = 0;
  std::size_t broken = 0;
  double work = 0.0;
  long force_evaluations = 0;
  bool has_touched = false;
  bool operator==(const OutcomeOnThreads&) const = default;
};

OutcomeOnThreads run_on_threads(const TestSim& sim, const Integrator& method, int threads) {
  Plan plan = make_plan(sim.system);
  if (threads > 1) plan.execution.team = std::make_shared<ThreadTeam>(threads, WhenLate::Wait);
  State state = sim.state;
  OutcomeOnThreads outcome;
  Frame frame;
  frame.begin(plan, sim.system, {.integrator = &method, .frame_rate = 2500.0, .substeps = 8}, state);
  while (!frame.done()) frame.substep(plan);
  frame.end(plan, state);
  outcome.hash = hash_state(state);
  outcome.broken = frame.broken().size();
  outcome.work = frame.motion().contact_work + frame.motion().collider_work;
  outcome.force_evaluations = frame.force_evaluations();
  outcome.has_touched = frame.has_touched();
  return outcome;
}

OutcomeOnThreads expect_same_bits_on_threads(const TestSim& sim, const Integrator& method, const std::string& what) {
  const OutcomeOnThreads one = run_on_threads(sim, method, 1);
  EXPECT_NE(one.hash, hash_state(sim.state)) << what;
  for (const int threads : {2, 3, 5, 16})
    EXPECT_EQ(run_on_threads(sim, method, threads), one) << what << ", " << method.id << ", " << threads;
  return one;
}

TestSim waving_cloth() {
  TestSim sim = cloth(points_of_side);
  for (std::size_t i = 0; i < sim.state.velocity.size(); ++i) {
    const Vec3& x = sim.state.position[i];
    if (sim.system.points()[i].nailed) continue;
    sim.state.velocity[i] = {std::sin(9.0 * x.y), std::cos(7.0 * x.x), std::sin(20.0 * x.x * x.y + 4.0)};
  }
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).radius = 1e-4;
  return sim;
}

TestSim cloth_with_holes() {
  TestSim sim = waving_cloth();
  std::vector<Spring> springs;
  for (std::size_t s = 0; s < sim.system.springs().size(); ++s)
    if (s % 7 != 3 && s % 101 != 5) springs.push_back(sim.system.springs()[s]);
  sim.system.set_springs(std::move(springs));
  for (Index i = 17; i < sim.system.point_count(); i += 331) {
    sim.system.point(i).nailed = true;
    sim.state.velocity[i] = Vec3(0.0);
  }
  return sim;
}

TEST(Threads, ComputeBandsOfRows) {
  Plan plan = make_plan(waving_cloth().system);
  ASSERT_EQ(plan.spring.grids.size(), 1u);
  const GridView<double> grid{.points = plan.points, .rows = points_of_side, .columns = points_of_side};
  for (const int threads : {1, 2, 3, 5, 16}) {
    plan.execution.team = std::make_shared<ThreadTeam>(threads, WhenLate::Wait);
    std::array<GridBand<double>, max_parts> band;
    const double* none = nullptr;
    EXPECT_EQ(for_bands(plan, grid, 1, false, none, none, [&](int part, int, const GridBand<double>& each) { band[part] = each; }),
              threads);
    EXPECT_EQ(band[0].begin, 0);
    for (int part = 1; part < threads; ++part) EXPECT_EQ(band[part].begin, band[part - 1].end);
    EXPECT_EQ(band[threads - 1].end, points_of_side);
  }
}

TEST(Threads, LeaveSmallScenesToOne) {
  Plan plan = make_plan(cloth(40).system);
  plan.execution.team = std::make_shared<ThreadTeam>(2, WhenLate::Wait);
  const GridView<double> grid{.points = plan.points, .rows = 40, .columns = 40};
  const double* none = nullptr;
  EXPECT_EQ(for_bands(plan, grid, 1, false, none, none, [](int, int, const GridBand<double>&) {}), 1);
}

TEST(Threads, ComputeTheSameBits) {
  TestSim sim = waving_cloth();
  for (const Integrator* method : {&velocity_verlet, &symplectic_euler, &explicit_euler, &runge_kutta4, &blanes_moan4, &xpbd})
    expect_same_bits_on_threads(sim, *method, "cloth");
  expect_same_bits_on_threads(cloth_with_holes(), xpbd, "missing springs and nails");
  expect_same_bits_on_threads(cloth_with_holes(), velocity_verlet, "missing springs and nails");
  expect_same_bits_on_threads(cloth_with_holes(), symplectic_euler, "missing springs and nails");
  sim.system.drag = 2.0;
  sim.system.wind = {1.0, 0.0, 2.0};
  expect_same_bits_on_threads(sim, velocity_verlet, "drag and wind");
  sim.system.forces.push_back({.term = &center_force, .values = default_values(center_force)});
  expect_same_bits_on_threads(sim, velocity_verlet, "a listed force");
  for (Index i = 0; i < 200; ++i) sim.join(sim.system.points()[13 * i].id, sim.system.points()[29 * i + 7].id, 3.0, 0.3);
  expect_same_bits_on_threads(sim, velocity_verlet, "springs across the cloth");
  expect_same_bits_on_threads(sim, xpbd, "springs across the cloth");
  sim = waving_cloth();
  std::vector<Spring> springs = sim.system.springs();
  for (Spring& spring : springs) spring.damping = 1e-4;
  sim.system.set_springs(std::move(springs));
  expect_same_bits_on_threads(sim, velocity_verlet, "dashpots");
  expect_same_bits_on_threads(sim, symplectic_euler, "dashpots");
  expect_same_bits_on_threads(sim, xpbd, "dashpots");
}

TEST(Threads, ComputeTheSameBitsInThePlane) {
  TestSim sim = waving_cloth();
  sim.system.dimensions = 2;
  for (Vec3& velocity : sim.state.velocity) velocity.z = 0.0;
  expect_same_bits_on_threads(sim, velocity_verlet, "in the plane");
}

TEST(Threads, ComputeTheSameContact) {
  TestSim sim = waving_cloth();
  const Collider ball{.shape = Sphere{{0.5, -0.5, -0.30015}, 0.3}, .restitution = 0.3, .friction = 0.2};
  const Collider floor{.shape = Plane{{0.0, 0.0, -0.00012}, {0.0, 0.0, 1.0}}, .friction = 0.5};
  for (const Collider& collider : {ball, floor}) {
    sim.system.colliders = {collider};
    const OutcomeOnThreads outcome = expect_same_bits_on_threads(sim, velocity_verlet, "contact");
    EXPECT_TRUE(outcome.has_touched);
    EXPECT_NE(outcome.work, 0.0);
  }
  // points that start inside are moved out
  sim.system.colliders = {Collider{.shape = Sphere{{0.5, -0.5, 0.0}, 0.2}, .restitution = 0.3, .friction = 0.2}};
  EXPECT_TRUE(expect_same_bits_on_threads(sim, velocity_verlet, "inside a ball").has_touched);
  sim.system.colliders[0].path = {.amplitude = {0.0, 0.0, 0.05}, .frequency = 200.0};
  EXPECT_TRUE(expect_same_bits_on_threads(sim, velocity_verlet, "a moving ball").has_touched);
}

TEST(Threads, BreakTheSameSprings) {
  TestSim sim = cloth_with_holes();
  for (Vec3& velocity : sim.state.velocity) velocity *= 10.0;
  sim.system.break_strain = 0.02;
  EXPECT_GT(expect_same_bits_on_threads(sim, velocity_verlet, "breakable").broken, 0u);
  sim.system.break_strain = 0.0;
  sim.system.strain_limit = 0.02;
  expect_same_bits_on_threads(sim, velocity_verlet, "a strain limit");
}

// Several runs may share a team: whoever finds it busy computes alone.
TEST(Threads, ShareATeam) {
  const TestSim sim = waving_cloth();
  const std::uint64_t hash = run_on_threads(sim, velocity_verlet, 1).hash;
  const auto team = std::make_shared<ThreadTeam>(2, WhenLate::Wait);
  std::array<std::uint64_t, 3> hashes{};
  {
    std::vector<std::jthread> runs;
    for (std::uint64_t& result : hashes)
      runs.emplace_back([&] {
        Plan plan = make_plan(sim.system);
        plan.execution.team = team;
        State state = sim.state;
        Frame frame;
        frame.begin(plan, sim.system, {.frame_rate = 2500.0, .substeps = 8}, state);
        while (!frame.done()) frame.substep(plan);
        frame.end(plan, state);
        result = hash_state(state);
      });
  }
  for (const std::uint64_t result : hashes) EXPECT_EQ(result, hash);
}

}  // namespace
}  // namespace hooke
