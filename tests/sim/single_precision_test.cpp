// Steps in single precision are those in double precision up to their rounding.
#include "sim/forces/single_precision.h"
#include "sim/forces/force_terms.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <memory>

#include "base/threads/thread_team.h"
#include "sim/forces/terms/rows.h"
#include "sim/methods/precision.h"
#include "sim/methods/rows.h"
#include "sim/model/hash.h"
#include "support/nets.h"

namespace hooke {
namespace {

State run_in_precision(const TestSim& sim, const Integrator& method, bool single, int threads = 1) {
  Plan plan = make_plan(sim.system);
  if (single) plan.execution.single = std::make_shared<SinglePrecision>();
  if (threads > 1) plan.execution.team = std::make_shared<ThreadTeam>(threads, WhenLate::Wait);
  State state = sim.state;
  Frame frame;
  for (int i = 0; i < 6; ++i) {
    frame.begin(plan, sim.system, {.integrator = &method, .frame_rate = 60.0, .substeps = 100}, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, state);
  }
  return state;
}

// Rounded numbers of up to `size` [m] differ by 6e-8 of it, hundreds of times.
void expect_single_close(const TestSim& sim, double size, const char* what) {
  for (const Integrator* method : {&velocity_verlet, &symplectic_euler}) {
    const State exact = run_in_precision(sim, *method, false), rounded = run_in_precision(sim, *method, true);
    EXPECT_GT(distance(exact, sim.state), 1e-3) << what << ", " << method->id;
    EXPECT_LT(distance(exact, rounded), 2e-6 * size) << what << ", " << method->id;
    EXPECT_GT(distance(exact, rounded), 1e-10 * size) << what << ", " << method->id;
    for (Index i = 0; i < sim.system.point_count(); ++i)
      EXPECT_TRUE(!sim.system.points()[i].nailed || rounded.position[i] == sim.state.position[i]);
  }
}

TEST(SinglePrecision, DiffersFromDoubleByItsRounding) {
  TestSim sim = net(33, 500.0, 0.0);
  expect_single_close(sim, 1.0, "net");
  sim.system.drag = 3.0;
  sim.system.wind = {2.0, 0.0, 1.0};
  expect_single_close(sim, 1.0, "drag and wind");
  for (int i = 0; i < 5; ++i) sim.add({0.1 * i, 0.5, 0.3}, 0.1, {0.0, 1.0, 0.0});
  expect_single_close(sim, 1.0, "free points");
  std::vector<Spring> springs = sim.system.springs();
  for (std::size_t s = 0; s < springs.size(); ++s) springs[s].stiffness *= 1.0 + 1e-3 * static_cast<double>(s % 7);
  springs.erase(springs.begin() + 500);
  sim.system.set_springs(std::move(springs));
  expect_single_close(sim, 1.0, "springs that differ, and a missing one");
  for (Vec3& position : sim.state.position) position += Vec3(1e6, -2e6, 5e5);
  expect_single_close(sim, 1.0, "far from the origin");
  sim = net(33, 500.0, 0.0);
  sim.system.dimensions = 2;
  for (std::size_t i = 0; i < sim.state.velocity.size(); ++i) sim.state.velocity[i] = {sim.state.velocity[i].z, 0.0, 0.0};
  expect_single_close(sim, 1.0, "in the plane");
}

TEST(SinglePrecision, HasTheSameBitsOnAnyNumberOfThreads) {
  const TestSim sim = cloth(67);
  const std::uint64_t hash = hash_state(run_in_precision(sim, velocity_verlet, true));
  for (const int threads : {2, 3, 4}) EXPECT_EQ(hash_state(run_in_precision(sim, velocity_verlet, true, threads)), hash) << threads;
}

TEST(SinglePrecision, HasTheSameBitsOnEveryVectorUnit) {
  const TestSim sim = cloth(37);
  const std::uint64_t hash = hash_state(run_in_precision(sim, velocity_verlet, true));
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    EXPECT_EQ(hash_state(run_in_precision(sim, velocity_verlet, true)), hash) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST(SinglePrecision, NamesWhatItDoesNotCompute) {
  const TestSim sim = cloth(12);
  const auto needs = [](const TestSim& of, const Integrator& method = velocity_verlet) {
    return needs_double_precision(make_plan(of.system), {.integrator = &method});
  };
  EXPECT_EQ(needs(sim), "");
  EXPECT_EQ(needs(sim, symplectic_euler), "");
  EXPECT_NE(needs(sim, runge_kutta4), "");
  EXPECT_EQ(needs(net(12, 500.0, 0.1)), "springs with dashpots");
  EXPECT_EQ(needs(cloth(4)), "scenes of less than 256 springs, or without a grid");
  TestSim other = sim;
  other.join(other.system.points()[0].id, other.system.points()[50].id, 1.0, 1.0);
  EXPECT_EQ(needs(other), "springs that are not part of a grid");
  other = sim;
  other.system.colliders = {Collider{.shape = Plane{{0.0, -2.0, 0.0}}}};
  EXPECT_EQ(needs(other), "contact");
  other = sim;
  other.system.forces.push_back({.term = &center_force, .values = default_values(center_force)});
  EXPECT_EQ(needs(other), "listed forces");
  other = sim;
  other.system.strain_limit = 0.1;
  EXPECT_EQ(needs(other), "breaking springs and the strain limit");
  other = sim;
  other.system.break_strain = 0.1;
  EXPECT_EQ(needs(other), "breaking springs and the strain limit");
}

}  // namespace
}  // namespace hooke
