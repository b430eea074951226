// Several substeps at once equal the same substeps one by one to rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/force_terms.h"
#include "sim/forces/terms/rows.h"
#include "support/fall.h"
#include "support/nets.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr int substeps = 40;

// `frames` frames of `per_frame` substeps each; a frame of one substep is never taken at once.
State run(const TestSim& sim, const Integrator& method, int frames, int per_frame) {
  State state = sim.state;
  Plan plan = make_plan(sim.system);
  Frame frame;
  for (int i = 0; i < frames; ++i) {
    frame.begin(plan, sim.system, {.integrator = &method, .frame_rate = static_cast<double>(frames) / frame_time, .substeps = per_frame},
                state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, state);
  }
  return state;
}

double largest_difference(const State& a, const State& b) {
  double max = 0.0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    max = std::max(max, glm::distance(a.position[i], b.position[i]));
    max = std::max(max, 1e-2 * glm::distance(a.velocity[i], b.velocity[i]));
  }
  return max;
}

std::vector<const Integrator*> methods_with_steps() {
  std::vector<const Integrator*> methods;
  for (const Integrator& method : integrators())
    if (method.steps != nullptr) methods.push_back(&method);
  return methods;
}

void expect_equal(const TestSim& sim, const char* what, double tolerance) {
  for (const Integrator* method : methods_with_steps()) {
    const State at_once = run(sim, *method, 1, substeps), one_by_one = run(sim, *method, substeps, 1);
    EXPECT_LT(largest_difference(at_once, one_by_one), tolerance) << method->id << ", " << what;
    EXPECT_GT(largest_difference(at_once, sim.state), 1e-4) << method->id << ", " << what;
  }
}

void expect_equal_to_rounding(const TestSim& sim, const char* what) { expect_equal(sim, what, 1e-12); }

TestSim swinging_net(double damping = 0.0) {
  TestSim sim = net(17, 500.0, damping);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).radius = 0.01;
  return sim;
}

TEST(StepsAtOnce, EqualThoseOneByOne) {
  expect_equal_to_rounding(swinging_net(), "undamped");
  // velocity_verlet_explicit predicts velocities from those of the step before in the same frame
  expect_equal(swinging_net(0.2), "dashpots", 1e-9);
  expect_equal_to_rounding(curtain(12, 300.0, 0.0), "diagonals");
  TestSim sim = swinging_net();
  sim.system.drag = 3.0;
  sim.system.wind = {2.0, 0.0, 1.0};
  expect_equal_to_rounding(sim, "drag");
  for (Index i = 0; i < 50; ++i) sim.join(sim.system.points()[3 * i].id, sim.system.points()[4 * i + 7].id, 30.0, 0.3);
  expect_equal_to_rounding(sim, "springs across the net");
  expect_equal_to_rounding(random_sim(4, 40, 90), "a graph without a grid");
}

// But not where something may act between them.
TEST(StepsAtOnce, AreTakenWhereNothingActsBetweenThem) {
  const auto calls_of = [](const TestSim& sim, const Integrator& method) {
    Plan plan = make_plan(sim.system);
    Frame frame;
    frame.begin(plan, sim.system, {.integrator = &method, .frame_rate = 60.0, .substeps = substeps}, sim.state);
    int calls = 0;
    for (; !frame.done(); ++calls) frame.substep(plan);
    EXPECT_LE(frame.force_evaluations(), substeps + 1) << method.id;
    return calls;
  };
  const TestSim sim = swinging_net();
  for (const Integrator* method : methods_with_steps()) {
    EXPECT_EQ(calls_of(sim, *method), 1) << method->id;
    TestSim other = sim;
    other.system.colliders = {Collider{.shape = Plane{{0.0, -5.0, 0.0}}}};
    EXPECT_EQ(calls_of(other, *method), substeps) << method->id;
    other = sim;
    other.system.break_strain = 3.0;
    EXPECT_EQ(calls_of(other, *method), substeps) << method->id;
    other = sim;
    other.system.forces.push_back({.term = &center_force, .values = default_values(center_force)});
    EXPECT_EQ(calls_of(other, *method), substeps) << method->id;
  }
}

}  // namespace
}  // namespace hooke
