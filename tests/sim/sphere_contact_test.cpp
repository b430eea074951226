// Contact of free points, as spheres of their radii, with faces and springs.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "sim/plan/surface_plan.h"
#include "support/convergence.h"
#include "support/folds.h"
#include "support/margin_run.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr double frame_of_spheres = 1.0 / 60.0;

PointId add_sphere(TestSim& sim, const Vec3& position, double radius, double mass, const Vec3& velocity = Vec3(0.0)) {
  const PointId id = sim.add(position, mass, velocity);
  sim.system.point(sim.system.index_of(id)).radius = radius;
  return id;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
  return glm::distance(p, t <= 0.0 ? a : t >= 1.0 ? b : a + t * (b - a));
}

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const auto is_inside = [&](const Vec3& from, const Vec3& to) { return glm::dot(glm::cross(to - from, p - from), normal) >= 0.0; };
  if (is_inside(a, b) && is_inside(b, c) && is_inside(c, a)) return std::abs(glm::dot(p - a, normal));
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

// [m], of the center of a sphere from the faces, or from the springs if there are none.
double distance_to_others(const TestSim& sim, PointId sphere) {
  const Vec3& p = sim.position(sphere);
  double min = 1e300;
  for (const Face& face : sim.system.faces)
    min = std::min(min, distance_to_triangle(p, sim.position(face.points[0]), sim.position(face.points[1]), sim.position(face.points[2])));
  if (sim.system.faces.size() == 0)
    for (const Spring& spring : sim.system.springs())
      min = std::min(min, distance_to_segment(p, sim.position(spring.first), sim.position(spring.second)));
  return min;
}

// A horizontal sheet of n x n points at z = 0, its border nailed on request.
TestSim horizontal_sheet(int n, bool is_nailed) {
  TestSim sim;
  sim.system.gravity = {0.0, 0.0, -9.81};
  folds::add_sheet(
      sim, n, [](double u, double v) { return Vec3(u - 0.5, v - 0.5, 0.0); }, folds::at_rest);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      if (is_nailed && (row == 0 || column == 0 || row + 1 == n || column + 1 == n))
        sim.system.point(sheet::at(n, row, column)).nailed = true;
  folds::touch(sim);
  return sim;
}

class SphereContactOf : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, SphereContactOf, testing::ValuesIn(every_method()), method_name);

TEST_P(SphereContactOf, KeepsABallOnATrampoline) {
  TestSim sim = horizontal_sheet(9, true);
  const PointId ball = add_sphere(sim, {0.03, 0.05, 0.2}, 0.08, 0.3);
  const bool diverges = method().stability == Stability::None;
  double lowest = 1.0;
  for (int i = 0; i < (diverges ? 10 : 60); ++i) {
    sim.run(method(), frame_of_spheres, 60);
    EXPECT_GT(distance_to_others(sim, ball), 0.08) << "frame " << i;
    lowest = std::min(lowest, sim.position(ball).z);
  }
  if (!diverges) {
    EXPECT_LT(lowest, 0.0);
  }
}

TEST_P(SphereContactOf, ConservesLinearMomentumToRounding) {
  for (const bool points_touch : {false, true}) {
    SCOPED_TRACE(points_touch);
    TestSim sim = horizontal_sheet(9, false);
    sim.system.gravity = Vec3(0.0);
    sim.system.contact.points = points_touch;
    for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).radius = 0.004;
    add_sphere(sim, {0.1, 0.03, 0.15}, 0.05, 0.1, {0.5, 0.0, -5.0});
    add_sphere(sim, {0.1, 0.05, 0.26}, 0.05, 0.1, {0.5, 0.0, -5.0});
    add_sphere(sim, {-0.2, 0.03, -0.15}, 0.02, 0.01, {0.0, 0.0, 3.0});
    const Vec3 before = compute_momentum(sim.system, sim.state).linear;
    for (int i = 0; i < (method().stability == Stability::None ? 2 : 6); ++i) sim.run(method(), frame_of_spheres, 60);
    EXPECT_LT(glm::distance(compute_momentum(sim.system, sim.state).linear, before), 1e-12);
    if (method().stability != Stability::None) {
      EXPECT_GT(sim.state.velocity[81].z, -4.5);
    }
  }
}

TEST(SphereContact, LetsNothingThroughAtAHundredMetersPerSecondInOneSubstepPerFrame) {
  TestSim sim = horizontal_sheet(9, false);
  sim.system.gravity = Vec3(0.0);
  const PointId bullet = add_sphere(sim, {0.03, 0.05, -0.5}, 0.002, 0.01, {0.0, 0.0, 100.0});
  for (int i = 0; i < 10; ++i) {
    sim.run(*find_integrator("implicit_euler"), frame_of_spheres, 1);
    double highest = -1.0;
    for (Index k = 0; k < 81; ++k) highest = std::max(highest, sim.state.position[k].z);
    EXPECT_LT(sim.position(bullet).z, highest) << "frame " << i;
  }
}

// In flat scenes a spring is a wall.
TEST_P(SphereContactOf, RestsOnAWallAtItsRadiusAndTheThickness) {
  TestSim sim;
  sim.system.dimensions = 2;
  sim.system.gravity = {0.0, -9.81, 0.0};
  sim.join(sim.nail({-0.1, 0.0, 0.0}), sim.nail({0.1, 0.0, 0.0}), 100.0, 0.2);
  sim.system.contact = {.springs = true, .thickness = 0.01};
  const PointId disc = add_sphere(sim, {0.02, 0.3, 0.0}, 0.1, 0.5);
  for (int i = 0; i < 40; ++i) sim.run(method(), frame_of_spheres, 20);
  EXPECT_NEAR(sim.position(disc).y, 0.11, 1e-5);
  // explicit Euler moves with the velocity before the last kick, which contact does not see
  EXPECT_NEAR(sim.velocity(disc).y, 0.0, &method() == find_integrator("explicit_euler") ? 9.82 * frame_of_spheres / 20 : 1e-6);
  EXPECT_NEAR(sim.position(disc).x, 0.02, 1e-12);
}

TEST(SphereContact, HangsARopeOverANailedSphere) {
  TestSim sim;
  constexpr int points = 24;
  std::vector<PointId> rope;
  for (int i = 0; i < points; ++i) rope.push_back(sim.add({0.05 * (i - 0.5 * (points - 1)), 0.15, 0.0}, 0.01));
  for (int i = 0; i + 1 < points; ++i) sim.join(rope[i], rope[i + 1], 2000.0, 0.05, 0.05);
  const PointId peg = add_sphere(sim, {0.0, 0.0, 0.0}, 0.1, 1.0);
  sim.system.point(sim.system.index_of(peg)).nailed = true;
  sim.system.gravity = {0.0, -9.81, 0.0};
  sim.system.contact = {.springs = true, .thickness = 0.01, .friction = 0.5};
  for (int i = 0; i < 90; ++i) {
    sim.run(default_integrator(), frame_of_spheres, 60);
    EXPECT_GT(distance_to_others(sim, peg), 0.1) << "frame " << i;
  }
  EXPECT_LT(sim.position(rope[0]).y, -0.2);
  EXPECT_GT(sim.position(rope[points / 2]).y, 0.1);
}

// The inelastic impact of a ball of mass M on the middle of two points of mass m: J = v / (1/M + 1/(2 m)).
TEST_P(SphereContactOf, HitsTheMiddleOfASpringAsTheClosedForm) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId first = sim.add({-0.5, 0.0, 0.0}, 0.3), second = sim.add({0.5, 0.0, 0.0}, 0.3);
  sim.join(first, second, 100.0, 1.0);
  const PointId ball = add_sphere(sim, {0.0, 0.2, 0.0}, 0.05, 0.2, {0.0, -2.0, 0.0});
  sim.system.contact = {.springs = true, .thickness = 0.01};
  for (int i = 0; i < 8; ++i) sim.run(method(), frame_of_spheres, 50);
  const double velocity = -2.0 * 0.2 / (0.2 + 0.6);
  EXPECT_NEAR(sim.velocity(ball).y, velocity, 1e-6);
  EXPECT_NEAR(sim.velocity(first).y, velocity, 1e-6);
  EXPECT_NEAR(sim.velocity(second).y, velocity, 1e-6);
}

// What hangs on springs that do not touch, or is on a face, is no sphere; without faces and springs that touch, nothing is.
TEST(SphereContact, IsThatOfPointsOnNoSpringOrFace) {
  TestSim sim = horizontal_sheet(3, false);
  const PointId hanging = sim.add({0.0, 0.0, 1.0});
  sim.join(hanging, sim.system.points()[0].id, 1.0, 1.0);
  EXPECT_TRUE(plan_surface(sim.system).radius.empty());
  add_sphere(sim, {0.0, 0.0, 2.0}, 0.5, 1.0);
  const SurfacePlan plan = plan_surface(sim.system);
  ASSERT_EQ(plan.radius.size(), 10U);
  EXPECT_EQ(plan.radius[9], 0.5);
  EXPECT_EQ(std::ranges::count(plan.radius, 0.0), 9);
  sim.system.contact = {.points = true};
  EXPECT_FALSE(plan_surface(sim.system).on);
}

TEST(SphereContact, LetsSpheresThroughEachOtherUnlessPointsTouch) {
  for (const bool points_touch : {false, true}) {
    TestSim sim = horizontal_sheet(3, false);
    sim.system.gravity = Vec3(0.0);
    sim.system.contact.points = points_touch;
    const PointId left = add_sphere(sim, {-0.2, 0.0, 1.0}, 0.1, 1.0, {1.0, 0.0, 0.0}),
                  right = add_sphere(sim, {0.2, 0.0, 1.0}, 0.1, 1.0, {-1.0, 0.0, 0.0});
    for (int i = 0; i < 30; ++i) sim.run(default_integrator(), frame_of_spheres, 40);
    EXPECT_EQ(sim.position(left).x < sim.position(right).x, points_touch);
  }
}

// Spheres of very different sizes fall on a sheet.
TEST(SphereContact, DoesNotDependOnTheMarginOfTheSearch) {
  TestSim sim = horizontal_sheet(9, true);
  Random random(7);
  for (int i = 0; i < 12; ++i) {
    const double radius = random.uniform(0.0, 0.15), x = random.uniform(-0.4, 0.4), y = random.uniform(-0.4, 0.4);
    add_sphere(sim, {x, y, radius + 0.02}, radius, 0.05, {0.0, 0.0, -2.0});
  }
  const auto run = [&](double margin, long& searches) { return run_with_margin(sim, margin, 300, searches); };
  long often = 0, usual = 0, rarely = 0;
  const auto expected = run(0.25, usual);
  EXPECT_EQ(run(0.01, often), expected);
  EXPECT_EQ(run(100.0, rarely), expected);
  EXPECT_GT(often, usual);
}

// Discs that fall into a funnel of nailed springs, which press them into each other.
TestSim discs_in_a_funnel(double friction) {
  TestSim sim;
  sim.system.dimensions = 2;
  sim.system.gravity = {0.0, -9.81, 0.0};
  sim.system.contact = {.points = true, .springs = true, .thickness = 0.008, .restitution = 0.2, .friction = friction};
  std::vector<PointId> rim;
  for (const Vec3& place : {Vec3(-0.4, 0.4, 0.0), Vec3(-0.05, 0.05, 0.0), Vec3(0.05, 0.05, 0.0), Vec3(0.4, 0.4, 0.0)})
    rim.push_back(sim.nail(place));
  for (const auto& [from, to] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 3)})
    sim.join(rim[from], rim[to], 1000.0, glm::distance(sim.position(rim[from]), sim.position(rim[to])));
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column)
      add_sphere(sim, {-0.12 + 0.06 * column + 0.011 * (row % 2), 0.35 + 0.06 * row, 0.0}, 0.02, 0.005 * (1 + (row + column) % 3));
  return sim;
}

// [m], the largest by which two discs overlap.
double overlap_of_discs(const TestSim& sim) {
  double max = 0.0;
  const std::vector<Point>& points = sim.system.points();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!points[i].nailed && !points[j].nailed)
        max = std::max(max, points[i].radius + points[j].radius + sim.system.contact.thickness -
                                glm::distance(sim.state.position[i], sim.state.position[j]));
  return max;
}

TEST_P(SphereContactOf, DoesNotPressDiscsIntoEachOtherInAFunnel) {
  for (const double friction : {0.0, 0.3}) {
    TestSim sim = discs_in_a_funnel(friction);
    double overlap = 0.0;
    for (int i = 0; i < 60; ++i) {
      sim.run(method(), frame_of_spheres, 20);
      overlap = std::max(overlap, overlap_of_discs(sim));
    }
    EXPECT_LT(overlap, 0.05 * 0.048) << friction;
    EXPECT_LT(sim.state.position.back().y, 0.6) << friction;
  }
}

// A spring far away changes nothing in an impact between spheres.
TEST_P(SphereContactOf, LeavesImpactsOfSpheresToContactOfPoints) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    std::array<TestSim, 2> sims;
    for (const bool has_spring : {false, true}) {
      TestSim& sim = sims[has_spring];
      sim.system.gravity = Vec3(0.0);
      sim.system.contact = {.points = true, .springs = has_spring, .thickness = 0.002, .restitution = restitution, .friction = 0.2};
      add_sphere(sim, {-0.1, 0.01, 0.0}, 0.03, 0.2, {2.0, 0.0, 0.3});
      add_sphere(sim, {0.1, 0.0, 0.0}, 0.05, 0.5, {-1.0, 0.1, 0.0});
      const PointId far = sim.nail({5.0, 0.0, 0.0});
      sim.join(far, sim.nail({5.0, 0.1, 0.0}), 100.0, 0.1);
      sim.run(method(), 0.1, 40);
    }
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(glm::distance(sims[0].state.velocity[i], sims[1].state.velocity[i]), 0.0, 1e-9) << restitution;
      EXPECT_NEAR(glm::distance(sims[0].state.position[i], sims[1].state.position[i]), 0.0, 1e-9) << restitution;
    }
  }
}

}  // namespace
}  // namespace hooke
