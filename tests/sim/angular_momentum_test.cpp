// Contact of faces and springs in free scenes: what it leaves of the angular momentum.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "support/convergence.h"
#include "support/folds.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

void add_free_rope(TestSim& sim, int n, const Vec3& from, const Vec3& to, const Vec3& velocity, double damping) {
  const Index first = sim.system.point_count();
  for (int i = 0; i < n; ++i) sim.add(from + i / (n - 1.0) * (to - from), 0.01, velocity);
  for (int i = 0; i + 1 < n; ++i) sheet::join(sim, first + i, first + i + 1, 500.0, damping, glm::length(to - from) / (n - 1));
}

TestSim crossing_ropes(double damping) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  add_free_rope(sim, 11, {-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, Vec3(0.0), damping);
  add_free_rope(sim, 12, {0.03, 0.1, -0.5}, {0.03, 0.1, 0.5}, {0.5, -10.0, 1.0}, damping);
  sim.system.contact = {.springs = true, .thickness = 0.01, .friction = 0.0};
  return sim;
}

// A sheet in free space that its velocities fold.
TestSim folding_sheet(double damping) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  folds::add_sheet(
      sim, 13, [](double u, double v) { return Vec3(u - 0.5, 0.02 * std::sin(7.0 * u + 5.0 * v), v - 0.5); },
      [](double u, double v) { return Vec3(2.0 * v - 16.0 * u + 7.0, 6.0 * std::sin(9.0 * u) + 4.0 * std::cos(6.0 * v), 1.0 - 2.0 * v); });
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->damping = damping;
  folds::touch(sim, 0.0);
  return sim;
}

std::vector<TestSim> free_scenes() {
  std::vector<TestSim> scenes{colliding_sheets(9), crossing_ropes(0.0), crossing_ropes(0.02), folding_sheet(0.0), folding_sheet(0.02)};
  folds::touch(scenes[0], 0.0);
  return scenes;
}

struct Angular {
  Vec3 momentum{0.0};
  double scale = 0.0;  // sum m |x| |v|
};

Angular angular_of(const Plan& plan, const Motion& motion) {
  Angular result;
  const std::size_t n = motion.x.size() / 3;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 x(motion.x[i], motion.x[n + i], motion.x[2 * n + i]), v(motion.v[i], motion.v[n + i], motion.v[2 * n + i]);
    result.momentum += plan.mass[i] * glm::cross(x, v);
    result.scale += plan.mass[i] * glm::length(x) * glm::length(v);
  }
  return result;
}

double scale_of(const TestSim& sim) {
  double scale = 0.0;
  for (Index i = 0; i < sim.system.point_count(); ++i)
    scale += sim.system.points()[i].mass * glm::length(sim.state.position[i]) * glm::length(sim.state.velocity[i]);
  return scale;
}

// The change over `frames` frames, relative to sum m |x| |v| at the start.
double relative_change(TestSim sim, const Integrator& method, int frames) {
  const double scale = scale_of(sim);
  const Vec3 before = compute_momentum(sim.system, sim.state).angular;
  for (int i = 0; i < frames; ++i) sim.run(method, 1.0 / 60.0, 80);
  return glm::distance(compute_momentum(sim.system, sim.state).angular, before) / scale;
}

class AngularMomentumOf : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, AngularMomentumOf, testing::ValuesIn(every_method()), method_name);

// Whatever the method makes of a step, contact leaves it to rounding.
TEST_P(AngularMomentumOf, IsUnchangedByContactWithoutFriction) {
  const bool diverges = method().stability == Stability::None;
  constexpr double h = 1.0 / 4800.0;
  int touches = 0;
  for (TestSim& sim : free_scenes()) {
    const Plan plan = make_plan(sim.system);
    Motion motion;
    Workspace work;
    ContactWorkspace contact;
    pack(plan, sim.state, motion);
    motion.memory = {.step = 1e9, .error = 1e-4};
    work.tolerance = 1e9;
    work.min_step = 1e-9 * h;
    contact.begin_frame();
    if (method().prepare != nullptr) method().prepare(plan, h, motion, work);
    for (int i = 0; i < (diverges ? 160 : 480); ++i) {
      contact.time = motion.time;
      contact.x = motion.x;
      contact.v = motion.v;
      if (method().step != nullptr)
        method().step(plan, motion, work, h);
      else
        ASSERT_EQ(method().advance(plan, motion, work, h), h);
      motion.time += h;
      const Angular before = angular_of(plan, motion);
      if (!resolve_contacts(plan, contact, motion, h)) continue;
      ++touches;
      motion.acceleration_is_current = false;
      const Angular after = angular_of(plan, motion);
      ASSERT_LT(glm::distance(after.momentum, before.momentum), 1e-14 * before.scale) << i;
    }
  }
  EXPECT_GT(touches, diverges ? 10 : 500);
}

// With methods that conserve it in free flight.
TEST(AngularMomentum, IsConservedToRoundingWithoutFriction) {
  for (const char* id : {"symplectic_euler", "velocity_verlet", "blanes_moan4", "implicit_midpoint"})
    for (const TestSim& sim : free_scenes()) EXPECT_LT(relative_change(sim, *find_integrator(id), 6), 1e-12) << id;
}

// Friction acts at two points a thickness apart.
TEST(AngularMomentum, ChangesLittleUnderFriction) {
  for (TestSim& sim : free_scenes()) {
    sim.system.contact.friction = 0.3;
    EXPECT_LT(relative_change(sim, default_integrator(), 6), 5e-3);
  }
}

// Two nets of spheres that fly into each other without friction: springs pull while they touch.
TEST(AngularMomentum, ChangesLittleByContactBetweenPoints) {
  for (int seed = 0; seed < 10; ++seed) {
    Random random(seed * 77 + 1);
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    for (const bool is_upper : {false, true}) {
      const Index first = sim.system.point_count();
      for (Index i = 0; i < 12; ++i) {
        const double x = random.uniform(-0.03, 0.03), z = random.uniform(-0.03, 0.03), u = random.uniform(-1.0, 1.0);
        const Index row = i / 4, column = i % 4;
        sim.add({0.2 * column + x, is_upper ? 0.3 : 0.0, 0.2 * row + z}, random.uniform(0.05, 0.3), {u, is_upper ? -3.0 : 0.0, x});
        sim.system.point(first + i).radius = random.uniform(0.04, 0.08);
        for (Index j = first; j < first + i; ++j) {
          const double length = glm::distance(sim.state.position[first + i], sim.state.position[j]);
          if (length < 0.25) sheet::join(sim, first + i, j, 500.0, 0.0, length);
        }
      }
    }
    sim.system.contact = {.points = true, .restitution = 0.5, .friction = 0.0};
    const double scale = scale_of(sim);
    const Vec3 before = compute_momentum(sim.system, sim.state).angular;
    for (int i = 0; i < 24; ++i) sim.run(default_integrator(), 1.0 / 60.0, 20);
    EXPECT_LT(glm::distance(compute_momentum(sim.system, sim.state).angular, before), 2e-4 * scale) << seed;
  }
}

}  // namespace
}  // namespace hooke
