// Points that rest or slide are solved by vectors to the bits of the solver of one point.
#include <gtest/gtest.h>

#include <hwy/targets.h>
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "sim/contact/point_contact.h"
#include "sim/contact/resting_kernel.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr std::size_t count = 1000;

// Points on, above and in some colliders, at rest or moving, and a step without contact.
struct RandomStep {
  Plan plan;
  double h;
  Field x0, v0, x1, v1;

  Vec3 at(const Field& field, std::size_t i) const { return {field[i], field[count + i], field[2 * count + i]}; }
  void set(Field& field, std::size_t i, const Vec3& value) const {
    for (int c = 0; c < 3; ++c) field[static_cast<std::size_t>(c) * count + i] = value[c];
  }

  explicit RandomStep(std::uint64_t seed) {
    Random random(seed);
    const auto vector = [&](double size) {
      const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
      return Vec3(x, y, z);
    };
    TestSim sim;
    h = random.one_of(std::vector{1e-4, 1e-3, 1.0 / 60.0});
    const std::vector<double> frictions{0.0, 0.3, 1.0, 30.0};
    sim.system.colliders.push_back({.shape = Sphere{vector(0.3), random.uniform(0.1, 2.0)}, .friction = random.one_of(frictions)});
    sim.system.colliders.push_back(
        {.shape = Plane{{0.0, -0.5, 0.0}, glm::normalize(Vec3(0.0, 1.0, 0.0) + vector(0.4))}, .friction = random.one_of(frictions)});
    if (random.one_in(2)) sim.system.colliders.push_back({.shape = Box{{-0.4, 0.2, -0.3}, {0.1, 0.5, 0.4}}, .friction = 0.2});
    for (Field* field : {&x0, &v0, &x1, &v1}) field->resize(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
      sim.add(vector(1.0), random.uniform(0.1, 2.0));
      Point& point = sim.system.point(static_cast<Index>(i));
      point.radius = random.one_in(2) ? 0.0 : random.uniform(0.0, 0.05);
      point.nailed = random.one_in(20);
    }
    plan = make_plan(sim.system);
    for (std::size_t i = 0; i < count; ++i) {
      const Collider& collider = plan.colliders[static_cast<std::size_t>(random.below(static_cast<Index>(plan.colliders.size())))];
      Vec3 x = sim.state.position[i], v = random.one_in(3) ? Vec3(0.0) : vector(random.one_of(std::vector{1e-9, 1e-4, 0.1, 5.0}));
      if (!random.one_in(4)) {
        // on the surface, sometimes up to some steps away from it
        for (int round = 0; round < 3; ++round) {
          const Gap gap = gap_to(collider, plan.radius[i], x);
          x -= gap.distance * gap.normal;
          v -= glm::dot(v, gap.normal) * gap.normal;
        }
        const Vec3 normal = gap_to(collider, plan.radius[i], x).normal;
        if (random.one_in(4)) x += random.uniform(-0.1, 1.0) * h * normal;
        if (random.one_in(4)) v += random.uniform(-1.0, 1.0) * normal;
      }
      const Vec3 a = random.one_in(4) ? Vec3(0.0, -9.81, 0.0) : vector(random.one_of(std::vector{1.0, 20.0, 1e4}));
      set(x0, i, x);
      set(v0, i, v);
      set(v1, i, v + h * a);
      set(x1, i, x + h * (v + 0.5 * h * a) + (random.one_in(2) ? Vec3(0.0) : vector(1e-2 * h)));
    }
  }
};

struct Results {
  std::array<RestingPoints::Outcome, RestingPoints::max> outcome;
  std::array<double, RestingPoints::max> work;
  RestingPoints points() { return {.outcome = outcome.data(), .work = work.data()}; }
};

struct Counts {
  int free = 0, solved = 0;
};

void compare(const RandomStep& step, Counts& counts) {
  std::vector<Obstacle> obstacles;
  find_obstacles(step.plan, 0.0, step.h, obstacles);
  Field x = step.x1, v = step.v1;
  Results results;
  RestingPoints resting = results.points();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i % RestingPoints::max;
    if (at == 0) solve_resting_points(step.plan, step.h, i, std::min(count, i + RestingPoints::max), step.x0, step.v0, x, v, resting);
    const Vec3 x0 = step.at(step.x0, i), v0 = step.at(step.v0, i), x1 = step.at(step.x1, i), v1 = step.at(step.v1, i);
    const Vec3 a = (v1 - v0) / step.h, velocity_correction = (x1 - x0) / step.h - v0 - 0.5 * step.h * a;
    PointContactSolver solver(obstacles, step.plan.radius[i], x0, v0);
    const bool is_fixed = step.plan.inverse_mass[i] == 0.0, touches = !is_fixed && solver.advance(a, velocity_correction, step.h);
    if (resting.outcome[at] == RestingPoints::Solved) {
      ++counts.solved;
      ASSERT_TRUE(touches);
      EXPECT_EQ(step.at(x, i), solver.x);
      EXPECT_EQ(step.at(v, i), solver.v);
      EXPECT_EQ(solver.first_touch, 0.0);
      EXPECT_EQ(solver.push_out, Vec3(0.0));
      EXPECT_EQ(resting.work[at], step.plan.mass[i] * (solver.gained - glm::dot(a, solver.x - x0)));
      continue;
    }
    EXPECT_EQ(resting.work[at], 0.0);
    EXPECT_EQ(step.at(x, i), x1);
    EXPECT_EQ(step.at(v, i), v1);
    if (resting.outcome[at] != RestingPoints::Free) continue;
    ++counts.free;
    EXPECT_FALSE(touches) << i;
  }
}

TEST(RestingPoints, HaveTheBitsOfThePointContactSolver) {
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    Counts counts;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) compare(RandomStep(seed), counts);
    EXPECT_GT(counts.solved, 2500) << hwy::TargetName(target);
    EXPECT_GT(counts.free, 5000) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST(RestingPoints, LeavesNumbersThatAreNotFiniteToThePointContactSolver) {
  RandomStep step(3);
  step.x1[7] = std::numeric_limits<double>::quiet_NaN();
  step.v0[8] = std::numeric_limits<double>::infinity();
  Results results;
  RestingPoints resting = results.points();
  Field x = step.x1, v = step.v1;
  step.plan.inverse_mass[7] = step.plan.inverse_mass[8] = 1.0;
  solve_resting_points(step.plan, step.h, 0, RestingPoints::max, step.x0, step.v0, x, v, resting);
  EXPECT_EQ(resting.outcome[7], RestingPoints::Open);
  EXPECT_EQ(resting.outcome[8], RestingPoints::Open);
}

}  // namespace
}  // namespace hooke
