// Several substeps at once equal the same substeps one by one to rounding, whatever acts on the points, also if something acts
// between them.
#include "sim/forces/flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/force_terms.h"
#include "sim/forces/terms/rows.h"
#include "support/nets.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr double frame_time = 1.0 / 60.0;
constexpr int substeps = 40;

struct Outcome {
  State state;
  Index broken = 0;
};

// `frames` frames of `per_frame` substeps each; a frame of one substep is never taken at once.
Outcome run(const TestSim& sim, const Integrator& method, int frames, int per_frame) {
  Outcome result{sim.state};
  System system = sim.system;
  Plan plan = make_plan(system);
  Frame frame;
  for (int i = 0; i < frames; ++i) {
    frame.begin(plan, system, {.integrator = &method, .frame_rate = static_cast<double>(frames) / frame_time, .substeps = per_frame},
                result.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, result.state);
    result.broken += static_cast<Index>(frame.broken().size());
    if (frame.broken().empty()) continue;
    std::vector<Spring> springs = system.springs();
    for (auto s = frame.broken().rbegin(); s != frame.broken().rend(); ++s) springs.erase(springs.begin() + *s);
    system.set_springs(springs);
    plan = make_plan(system);
  }
  return result;
}

double largest_difference(const State& a, const State& b) {
  double max = 0.0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    max = std::max(max, glm::distance(a.position[i], b.position[i]));
    max = std::max(max, 1e-2 * glm::distance(a.velocity[i], b.velocity[i]));
  }
  return max;
}

std::vector<const Integrator*> flying_methods() {
  std::vector<const Integrator*> methods;
  for (const Integrator& method : integrators())
    if (method.fly != nullptr) methods.push_back(&method);
  return methods;
}

// Of a step that follows another one.
long evaluations_per_step(const Integrator& method, const TestSim& sim) {
  const Plan plan = make_plan(sim.system);
  constexpr double h = frame_time / substeps;
  Motion motion;
  Workspace work;
  pack(plan, sim.state, motion);
  if (method.prepare != nullptr) method.prepare(plan, h, motion, work);
  method.step(plan, motion, work, h);
  const long before = motion.counts.force_evaluations;
  method.step(plan, motion, work, h);
  return motion.counts.force_evaluations - before;
}

void expect_equal(const TestSim& sim, const char* what, double tolerance) {
  for (const Integrator* method : flying_methods()) {
    const Outcome at_once = run(sim, *method, 1, substeps), one_by_one = run(sim, *method, substeps, 1);
    EXPECT_LT(largest_difference(at_once.state, one_by_one.state), tolerance) << method->id << ", " << what;
    EXPECT_GT(largest_difference(at_once.state, sim.state), 1e-4) << method->id << ", " << what;
  }
}

void expect_equal_to_rounding(const TestSim& sim, const char* what) { expect_equal(sim, what, 1e-12); }

TestSim swinging_net(double damping = 0.0) {
  TestSim sim = net(17, 500.0, damping);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).radius = 0.01;
  return sim;
}

TEST(Flight, EqualsStepsOneByOne) {
  expect_equal_to_rounding(swinging_net(), "undamped");
  // velocity_verlet predicts velocities from those of the step before in the same frame
  expect_equal(swinging_net(0.2), "dashpots", 1e-9);
  expect_equal_to_rounding(curtain(12, 300.0, 0.0), "diagonals");
  TestSim sim = swinging_net();
  sim.system.drag = 3.0;
  sim.system.wind = {2.0, 0.0, 1.0};
  expect_equal_to_rounding(sim, "drag");
  sim.system.forces.push_back({.term = &center_force, .values = default_values(center_force)});
  expect_equal_to_rounding(sim, "a listed force");
  for (Index i = 0; i < 50; ++i) sim.join(sim.system.points()[3 * i].id, sim.system.points()[4 * i + 7].id, 30.0, 0.3);
  expect_equal_to_rounding(sim, "springs across the net");
  expect_equal_to_rounding(random_sim(4, 40, 90), "a graph without a grid");
}

TEST(Flight, TakesFewerForceEvaluationsThanTwiceTheSteps) {
  const TestSim sim = swinging_net();
  for (const Integrator* method : flying_methods()) {
    Plan plan = make_plan(sim.system);
    Frame frame;
    frame.begin(plan, sim.system, {.integrator = method, .frame_rate = 60.0, .substeps = substeps}, sim.state);
    int calls = 0;
    for (; !frame.done(); ++calls) frame.substep(plan);
    EXPECT_LT(calls, 4) << method->id;
    EXPECT_LE(frame.force_evaluations(), evaluations_per_step(*method, sim) * substeps + 1) << method->id;
  }
}

// A floor that the net hits within the frame, and one that it nearly reaches.
TEST(Flight, IsTakenBackWhenAPointTouchesACollider) {
  TestSim sim = swinging_net();
  double lowest = 0.0;
  for (Index i = 0; i < sim.system.point_count(); ++i) {
    sim.system.point(i).nailed = false;
    sim.state.velocity[i] = {0.0, -3.0, 0.0};
    lowest = std::min(lowest, sim.state.position[i].y);
  }
  const auto floor_at = [](double y) { return Collider{.shape = Plane{{0.0, y, 0.0}}, .restitution = 0.5, .friction = 0.3}; };
  const Collider ball{.shape = Sphere{{0.5, lowest - 0.33, 0.0}, 0.3}, .restitution = 0.5};
  const Collider box{.shape = Box{{0.2, lowest - 1.0, -1.0}, {0.4, lowest - 0.03, 1.0}}, .restitution = 0.5};
  for (const Collider& collider : {floor_at(lowest - 0.03), floor_at(lowest - 0.045), floor_at(lowest - 0.08), ball, box}) {
    sim.system.colliders = {collider};
    expect_equal_to_rounding(sim, "a collider");
  }
  sim.system.colliders = {floor_at(lowest - 0.03)};
  const State touched = run(sim, default_integrator(), 1, substeps).state;
  sim.system.colliders.clear();
  EXPECT_GT(largest_difference(touched, run(sim, default_integrator(), 1, substeps).state), 1e-3);
}

TEST(Flight, IsTakenBackWhenASpringBreaksOrIsTooLong) {
  TestSim sim = swinging_net();
  for (Vec3& velocity : sim.state.velocity) velocity *= 40.0;
  for (const double strain : {0.05, 0.1, 3.0}) {
    sim.system.break_strain = strain;
    for (const Integrator* method : flying_methods()) {
      const Outcome at_once = run(sim, *method, 1, substeps), one_by_one = run(sim, *method, substeps, 1);
      EXPECT_LT(largest_difference(at_once.state, one_by_one.state), 1e-12) << method->id;
      EXPECT_EQ(at_once.broken, one_by_one.broken) << method->id;
      EXPECT_EQ(at_once.broken > 0, strain < 1.0) << method->id << ", " << strain;
    }
  }
  sim.system.break_strain = 0.0;
  for (const double strain : {0.05, 0.2, 3.0}) {
    sim.system.strain_limit = strain;
    expect_equal_to_rounding(sim, "a strain limit");
  }
}

// Held by friction against its springs: after a substep that changes no bit, the rest of the frame is not computed.
TEST(Flight, IsNotNeededForASceneAtRest) {
  TestSim sim = cloth(20);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = false;
  for (Vec3& x : sim.state.position) x = Vec3(x.x * (1.0 + 1e-6), x.y + 0.0, x.z);  // no negative zeros, which contact would change
  sim.system.colliders = {{.shape = Plane{Vec3(0.0), {0.0, 0.0, 1.0}}, .friction = 0.5}};
  for (const Integrator* method : flying_methods()) {
    Plan plan = make_plan(sim.system);
    Frame frame;
    const auto begin = [&](int count) {
      frame.begin(plan, sim.system, {.integrator = method, .frame_rate = 40.0 / count / frame_time, .substeps = count}, sim.state);
      frame.substep(plan);
      EXPECT_TRUE(frame.done()) << method->id;
      EXPECT_TRUE(frame.has_touched()) << method->id;
      return frame.force_evaluations();
    };
    const long evaluations = begin(1);
    const double work = frame.motion().energy[EnergyCause::Contact];
    EXPECT_EQ(begin(40), 40 * evaluations) << method->id;
    EXPECT_NEAR(frame.motion().energy[EnergyCause::Contact], 40.0 * work, 1e-10 * std::abs(work)) << method->id;
    State end = sim.state;
    frame.end(plan, end);
    EXPECT_EQ(end.position, sim.state.position) << method->id;
    EXPECT_EQ(end.velocity, sim.state.velocity) << method->id;
    EXPECT_DOUBLE_EQ(end.time, frame_time);
  }
}

}  // namespace
}  // namespace hooke
