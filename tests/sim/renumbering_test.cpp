// Scenes that are stepped in another order of their points (numbering/point_order.h) move as those that are stepped as listed, to rounding,
// with everything that refers to points.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <string>

#include "base/threads/thread_team.h"
#include "sim/control/frame_error.h"
#include "sim/control/frame_runner.h"
#include "sim/forces/energy/energy.h"
#include "sim/forces/force_terms.h"
#include "sim/model/hash.h"
#include "sim/plan/hinges.h"
#include "sim/step/divergence.h"
#include "support/automatic_runs.h"
#include "support/convergence.h"
#include "support/force_with.h"
#include "support/shuffled.h"

namespace hooke {
namespace {

constexpr int side = 16;

// A cloth that waves in gravity.
TestSim waving_sheet() {
  TestSim sim = cloth(side);
  for (std::size_t i = 0; i < sim.state.velocity.size(); ++i) {
    const Vec3& x = sim.state.position[i];
    if (!sim.system.points()[i].nailed) sim.state.velocity[i] = {std::sin(9.0 * x.y), std::cos(7.0 * x.x), std::sin(20.0 * x.x * x.y)};
  }
  return sim;
}

void add_faces(TestSim& sim) {
  const auto id = [&](int r, int c) { return sim.system.points()[r * side + c].id; };
  for (int r = 0; r + 1 < side; ++r)
    for (int c = 0; c + 1 < side; ++c) {
      sim.system.faces.push_back({.points = {id(r, c), id(r + 1, c), id(r, c + 1)}});
      sim.system.faces.push_back({.points = {id(r + 1, c), id(r + 1, c + 1), id(r, c + 1)}});
    }
}

void set_radius(TestSim& sim, double radius) {
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).radius = radius * (1.0 + 0.1 * (i % 3));
}

struct OrderedRun {
  State state;
  std::vector<Index> broken;
  double work = 0.0;
  bool has_touched = false;
};

OrderedRun run_in(Numbering numbering, const TestSim& sim, const Settings& settings, int frames = 3, int threads = 1) {
  Plan plan = make_plan(sim.system, numbering);
  EXPECT_EQ(plan.numbering.index.empty(), numbering == Numbering::AsListed);
  if (threads > 1) plan.execution.team = std::make_shared<ThreadTeam>(threads, WhenLate::Wait);
  FrameRunner frame;
  OrderedRun run{.state = sim.state};
  for (int i = 0; i < frames; ++i) {
    frame.begin(plan, sim.system, settings, run.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, run.state);
    run.broken.insert(run.broken.end(), frame.broken().begin(), frame.broken().end());
    run.work += frame.motion().hand_work + frame.motion().collider_work + frame.motion().force_work + frame.motion().contact_work;
    run.has_touched = run.has_touched || frame.has_touched();
  }
  std::ranges::sort(run.broken);
  return run;
}

Settings settings_of(const Integrator& method, int substeps = 20) {
  return {.integrator = &method, .frame_rate = 500.0, .substeps = substeps};
}

OrderedRun expect_same_motion(const TestSim& sim, const Settings& settings, double tolerance, const std::string& what, int frames = 3) {
  const TestSim mixed = shuffled(sim);
  const OrderedRun listed = run_in(Numbering::AsListed, mixed, settings, frames);
  OrderedRun fast = run_in(Numbering::Fastest, mixed, settings, frames);
  EXPECT_GT(distance(mixed.state, fast.state), 1e-4) << what;
  EXPECT_LT(distance(listed.state, fast.state), tolerance) << what;
  EXPECT_EQ(listed.broken, fast.broken) << what;
  EXPECT_NEAR(listed.work, fast.work, tolerance * (1.0 + 100.0 * std::abs(listed.work))) << what;
  EXPECT_EQ(listed.has_touched, fast.has_touched) << what;
  EXPECT_EQ(run_in(Numbering::Fastest, mixed, settings, frames, 4).state, fast.state) << what;
  return fast;
}

// [m]; sweeps over springs one after another depend on their order beyond rounding
double tolerance_of(const Integrator& method) { return method.id == "xpbd" ? 1e-4 : 1e-11; }

class Renumbered : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Renumbered, testing::ValuesIn(every_method()), method_name);

TEST_P(Renumbered, ClothMovesAsListed) { expect_same_motion(waving_sheet(), settings_of(method()), tolerance_of(method()), "cloth"); }

TEST_P(Renumbered, ClothIsHeldAndPulledWhereTheHandIs) {
  TestSim sim = waving_sheet();
  const Vec3 start = sim.state.position[100];
  sim.state.hand = {.position = start, .target = start + Vec3(0.002, 0.001, 0.003)};
  sim.system.grab = Grab{.point = sim.system.points()[100].id, .kind = GrabKind::Hold};
  const OrderedRun held = expect_same_motion(sim, settings_of(method()), tolerance_of(method()), "held", 1);
  const auto at = static_cast<std::size_t>(shuffled(sim).system.index_of(sim.system.points()[100].id));
  EXPECT_EQ(held.state.position[at], sim.state.hand.target);
  sim.system.grab->kind = GrabKind::Pull;
  expect_same_motion(sim, settings_of(method()), tolerance_of(method()), "pulled");
  sim.system.grab->patch =
      Patch{.points = {sim.system.points()[100].id, sim.system.points()[101].id, sim.system.points()[117].id}, .weights = {0.2, 0.5, 0.3}};
  expect_same_motion(sim, settings_of(method()), tolerance_of(method()), "pulled between points");
}

TEST_P(Renumbered, ClothTouchesCollidersAsListed) {
  TestSim sim = waving_sheet();
  set_radius(sim, 0.004);
  sim.system.colliders.push_back({.shape = Plane{{0.0, 0.0, -0.006}, {0.0, 0.0, 1.0}}, .friction = 0.3});
  sim.system.colliders.push_back({.shape = Sphere{{0.5, -0.5, -0.2}, 0.19}, .restitution = 0.5});
  const OrderedRun run = expect_same_motion(sim, settings_of(method()), std::max(1e-8, tolerance_of(method())), "colliders");
  // an adaptive method counts what touches within its own steps
  EXPECT_TRUE(run.has_touched || method().stability == Stability::Adaptive);
}

TEST(Renumbering, DoesNotChangeForces) {
  for (const ForceTerm& term : force_terms())
    for (const char* id : {"velocity_verlet", "implicit_midpoint"}) {
      TestSim sim = waving_sheet();
      set_radius(sim, 0.004);
      add_faces(sim);
      set_rest_angles(sim.system, sim.state.position);
      sim.system.drag = 0.5;
      sim.system.forces.push_back({.term = &term, .values = default_values(term)});
      expect_same_motion(sim, settings_of(*find_integrator(id)), 1e-9, std::string(term.id) + ", " + id);
    }
}

TEST(Renumbering, DoesNotChangeDashpotsThatAreSolvedTogether) {
  TestSim sim = waving_sheet();
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->damping = 1e-3 * (1 + s % 4);
  for (const char* id : {"implicit_midpoint", "runge_kutta4", "baraff_witkin"})
    expect_same_motion(sim, settings_of(*find_integrator(id)), 1e-10, id);
  // one after another: an error of the second order in the step
  expect_same_motion(sim, settings_of(*find_integrator("velocity_verlet")), 1e-5, "velocity_verlet");
}

TEST(Renumbering, BreaksTheSameSprings) {
  TestSim sim = waving_sheet();
  sim.system.break_strain = 0.04;
  for (Vec3& v : sim.state.velocity) v *= 3.0;
  EXPECT_GT(expect_same_motion(sim, settings_of(*find_integrator("velocity_verlet")), 1e-9, "breaking", 8).broken.size(), 10u);
}

// pairs push each other apart one after another
TEST(Renumbering, DoesNotChangeContactOfPartsWithEachOther) {
  for (const bool faces : {false, true}) {
    TestSim sim = waving_sheet();
    set_radius(sim, 0.02);
    add_faces(sim);
    sim.system.contact = {.points = !faces, .faces = faces, .thickness = 0.01};
    // the lower half is folded upwards
    for (Vec3& x : sim.state.position)
      if (x.y < -0.5) x = {x.x, -1.0 - x.y, 0.03 + 0.03 * (-x.y - 0.5)};
    for (std::size_t i = 0; i < sim.state.velocity.size(); ++i)
      sim.state.velocity[i] = sim.state.position[i].z > 0.0 ? Vec3(0.0, 0.0, -3.0) : Vec3(0.0);
    const OrderedRun run = expect_same_motion(sim, settings_of(*find_integrator("velocity_verlet")), 2e-4, faces ? "faces" : "points", 6);
    EXPECT_TRUE(run.has_touched);
  }
}

TEST(Renumbering, DoesNotChangeWhatAutoChooses) {
  const TestSim sim = waving_sheet();
  const OrderedRun run = expect_same_motion(sim, automatic(1e-3), 1e-7, "auto");
  ASSERT_TRUE(run.state.memory.choice);
  const OrderedRun listed = run_in(Numbering::AsListed, shuffled(sim), automatic(1e-3));
  EXPECT_EQ(run.state.memory.choice->method, listed.state.memory.choice->method);
  EXPECT_EQ(run.state.memory.choice->substeps, listed.state.memory.choice->substeps);
}

TEST(Renumbering, StepsPartsThatAreNotJoinedTheSame) {
  TestSim sim = waving_sheet();
  const std::vector<Spring> springs = sim.system.springs();
  const TestSim other = waving_sheet();
  const Index begin = sim.system.point_count();
  for (Index i = 0; i < begin; ++i) sim.add(other.state.position[i] + Vec3(3.0, 0.0, 0.0), 1e-3, other.state.velocity[i]);
  for (const Spring& spring : springs)
    sim.join(sim.system.points()[begin + other.system.index_of(spring.first)].id,
             sim.system.points()[begin + other.system.index_of(spring.second)].id, 1e-3 * spring.stiffness, spring.rest_length);
  expect_same_motion(sim, automatic(1e-3), 1e-7, "two sheets");
}

TEST(Renumbering, DoesNotChangeTheEstimateOfTheError) {
  const TestSim sim = waving_sheet();
  const Settings settings = settings_of(*find_integrator("velocity_verlet"), 8);
  const TestSim mixed = shuffled(sim);
  const double listed = estimate_frame_error(sim.system, settings, sim.state);
  EXPECT_NEAR(estimate_frame_error(mixed.system, settings, mixed.state), listed, 1e-6 * listed);
}

TEST(Renumbering, GivesTheSameBitsOnAnyNumberOfThreads) {
  const TestSim sim = shuffled(cloth(129));
  for (const char* id : {"velocity_verlet", "runge_kutta4"}) {
    const auto hash_on = [&](int threads) {
      return hash_state(
          run_in(Numbering::Fastest, sim, {.integrator = find_integrator(id), .frame_rate = 2500.0, .substeps = 8}, 2, threads).state);
    };
    EXPECT_EQ(hash_on(4), hash_on(1)) << id;
    EXPECT_NE(hash_on(1), hash_state(sim.state));
  }
}

// the structure is that of the springs, whatever their values
TEST(Renumbering, OutlivesChangesOfValues) {
  TestSim sim = shuffled(waving_sheet());
  Plan plan = make_plan(sim.system);
  for (Index i = 0; i < sim.system.point_count(); i += 7) sim.system.point(i).nailed = !sim.system.points()[i].nailed;
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).mass *= 1.0 + 0.01 * i;
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->stiffness *= 1.0 + 0.001 * s;
  refresh_values(plan, sim.system);
  const Plan made = make_plan(sim.system);
  EXPECT_EQ(plan.numbering.index, made.numbering.index);
  EXPECT_EQ(plan.inverse_mass, made.inverse_mass);
  EXPECT_EQ(plan.mass, made.mass);
  EXPECT_EQ(plan.spring.stiffness, made.spring.stiffness);
}

}  // namespace
}  // namespace hooke
