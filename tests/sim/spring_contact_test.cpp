// Contact of springs: ropes that lie on each other and on sheets, in three dimensions and in the plane.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "support/convergence.h"
#include "support/folds.h"

namespace hooke {
namespace {

// A rope of n points, nailed at both ends or free. Returns the index of its first point.
Index add_rope(TestSim& sim, int n, const Vec3& from, const Vec3& to, bool is_nailed) {
  const Index first = sim.system.point_count();
  const double a = glm::length(to - from) / (n - 1);
  for (int i = 0; i < n; ++i) sim.add(from + i / (n - 1.0) * (to - from), 0.01);
  for (int i = 0; i + 1 < n; ++i) sheet::join(sim, first + i, first + i + 1, 500.0, 0.02, a);
  if (is_nailed)
    for (const Index end : {first, first + n - 1}) sim.system.point(end).nailed = true;
  return first;
}

void run(TestSim& sim, double seconds) {
  for (int i = 0; i < static_cast<int>(60.0 * seconds); ++i) sim.run(default_integrator(), 1.0 / 60.0, 30);
}

TEST(SpringContact, HoldsARopeOnAnother) {
  for (const bool touches : {false, true}) {
    TestSim sim;
    add_rope(sim, 11, {-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, true);
    const Index upper = add_rope(sim, 12, {0.03, 0.1, -0.5}, {0.03, 0.1, 0.5}, false);
    sim.system.contact = {.springs = touches, .thickness = 0.01, .friction = 0.5};
    run(sim, 1.0);
    const double middle = 0.5 * (sim.state.position[upper + 5].y + sim.state.position[upper + 6].y);
    if (touches)
      EXPECT_GT(middle, sim.state.position[5].y);
    else
      EXPECT_LT(middle, -3.0);
  }
}

TEST(SpringContact, MakesSpringsWallsInThePlane) {
  for (const bool touches : {false, true}) {
    TestSim sim;
    sim.system.dimensions = 2;
    add_rope(sim, 11, {-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, true);
    const Index upper = add_rope(sim, 4, {-0.1, 0.2, 0.0}, {0.07, 0.2, 0.0}, false);
    sim.system.contact = {.springs = touches, .thickness = 0.01, .friction = 0.5};
    run(sim, 1.0);
    for (Index i = upper; i < upper + 4; ++i) {
      if (touches)
        EXPECT_GT(sim.state.position[i].y, -0.2) << i;
      else
        EXPECT_LT(sim.state.position[i].y, -3.0) << i;
    }
  }
}

TEST(SpringContact, HoldsARopeOnASheet) {
  TestSim sim;
  folds::add_sheet(
      sim, 9, [](double u, double v) { return Vec3(u - 0.5, 0.0, v - 0.5); }, folds::at_rest);
  for (Index i = 0; i < 81; ++i) sim.system.point(i).nailed = i % 9 == 0 || i % 9 == 8;
  const Index rope = add_rope(sim, 8, {-0.11, 0.05, -0.2}, {0.17, 0.05, 0.13}, false);
  sim.system.contact = {.springs = true, .faces = true, .thickness = 0.01, .friction = 0.3};
  run(sim, 1.0);
  for (Index i = rope; i < rope + 8; ++i) EXPECT_GT(sim.state.position[i].y, -0.6) << i;
}

// A spring that passes through a face at the start leaves faces that are apart alone: the point of a face on which it hangs does not
// follow.
TEST(SpringContact, ThroughAFaceLeavesFacesApart) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const auto add_face = [&](const std::array<PointId, 3>& points) { sim.system.faces.push_back({.points = points}); };
  add_face({sim.nail({-1.0, 0.0, -1.0}), sim.nail({1.0, 0.0, -1.0}), sim.nail({0.0, 0.0, 1.0})});
  const Vec3 down(0.0, -1.0, 0.0);
  const PointId corner = sim.add({0.0, 0.1, -0.3}, 1.0, down);
  add_face({corner, sim.add({0.1, 0.2, -0.3}, 1.0, down), sim.add({0.0, 0.2, -0.2}, 1.0, down)});
  const PointId inner = sim.add({0.02, -0.1, -0.35});
  sim.join(corner, inner, 1.0, 0.2);
  sim.system.contact = {.springs = true, .faces = true, .thickness = 0.004};
  for (const Integrator* method : every_method()) {
    TestSim each = sim;
    for (int i = 0; i < 12; ++i) each.run(*method, 1.0 / 60.0, 8);
    EXPECT_GT(each.position(corner).y, 0.0) << method->id;
    EXPECT_LT(each.position(inner).y, 0.0) << method->id;
  }
}

// Springs of a jelly pass the edges of faces that others join to them. That switches nothing off: their points do not follow.
TEST(SpringContact, ThroughAFaceThatAnotherJoinsLeavesItsPointsApart) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId corner = sim.nail({-1.0, 0.0, -1.0}), outer = sim.nail({0.0, 1.0, 0.0});
  sim.system.faces.push_back({.points = {corner, sim.nail({1.0, 0.0, -1.0}), sim.nail({0.0, 0.0, 1.0})}});
  const PointId inner = sim.add({0.02, -0.1, -0.05}, 1.0, {0.0, 1.0, 0.0});
  sim.join(outer, inner, 0.1, 1.1);
  sim.join(outer, corner, 0.1, 1.7);
  sim.system.contact = {.springs = true, .faces = true, .thickness = 0.004};
  for (const Integrator* method : every_method()) {
    TestSim each = sim;
    for (int i = 0; i < 12; ++i) each.run(*method, 1.0 / 60.0, 8);
    EXPECT_LT(each.position(inner).y, 0.0) << method->id;
  }
}

TEST(SpringContact, ConservesLinearMomentum) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  add_rope(sim, 11, {-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, false);
  const Index upper = add_rope(sim, 12, {0.03, 0.1, -0.5}, {0.03, 0.1, 0.5}, false);
  for (Index i = upper; i < sim.system.point_count(); ++i) sim.state.velocity[i] = Vec3(0.5, -10.0, 1.0);
  sim.system.contact = {.springs = true, .thickness = 0.01, .friction = 0.5};
  const Vec3 before = compute_momentum(sim.system, sim.state).linear;
  run(sim, 0.1);
  EXPECT_GT(sim.state.velocity[upper + 6].y, -9.0);
  EXPECT_LT(glm::length(compute_momentum(sim.system, sim.state).linear - before), 1e-13);
}

class SpringContactOf : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, SpringContactOf, testing::ValuesIn(every_method()), method_name);

// Two bars that hit each other in free space, at s and t of their lengths: with weights w = 1 - s, s, -(1 - t), -t of their ends the normal
// velocity sum w v vanishes by an impulse J = v / sum w^2 / m at the place of contact, which changes the velocity of each end by w J / m.
// A part of it acts where the bars are at the end of the step of 1 ms.
TEST_P(SpringContactOf, OfTwoBarsIsAnInelasticImpact) {
  constexpr double s = 0.3, t = 0.6, speed = 2.0, thickness = 0.06;
  constexpr std::array<double, 4> weight{1.0 - s, s, t - 1.0, -t}, mass{0.1, 0.3, 0.2, 0.25};
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const std::array<Vec3, 4> x{Vec3(-s, 0.1, 0.0), Vec3(1.0 - s, 0.1, 0.0), Vec3(0.0, 0.0, -t), Vec3(0.0, 0.0, 1.0 - t)};
  for (int i = 0; i < 4; ++i) sim.add(x[i], mass[i], {0.0, i < 2 ? -speed : 0.0, 0.0});
  for (const Index i : {0, 2}) sheet::join(sim, i, i + 1, 1e-6, 0.0, 1.0);
  sim.system.contact = {.springs = true, .thickness = thickness, .friction = 0.3};
  sim.run(method(), 0.0203, 20);  // the last step is that of the impact
  double response = 0.0;
  for (int i = 0; i < 4; ++i) response += weight[i] * weight[i] / mass[i];
  for (int i = 0; i < 4; ++i) {
    const double before = i < 2 ? -speed : 0.0;
    EXPECT_NEAR(sim.state.velocity[i].y, before + weight[i] * speed / response / mass[i], 5e-5) << i;
    EXPECT_NEAR(sim.state.velocity[i].x, 0.0, 5e-5) << i;
  }
}

// A rope of three springs between two nails lies across another: the middle of its middle spring is on that of the other, a thickness above
// it. What its springs and its weight leave over on the upper one, the lower one carries.
TEST(SpringContact, OfARopeAcrossAnotherIsBalanced) {
  constexpr double k = 200.0, a = 0.2, m = 0.05, thickness = 0.01, g = 9.81;
  TestSim sim;
  for (const bool is_upper : {false, true}) {
    const Index first = sim.system.point_count();
    for (int i = 0; i < 4; ++i) {
      const double along = a * (i - 1.5);
      sim.add(is_upper ? Vec3(0.0, 0.0, along) : Vec3(along, -0.03, 0.0), is_upper ? 3.0 * m : m);
      sim.system.point(first + i).nailed = i == 0 || i == 3;
      if (i > 0) sheet::join(sim, first + i - 1, first + i, k, 1.0, a);
    }
  }
  sim.system.contact = {.springs = true, .thickness = thickness, .friction = 0.3};
  sim.system.drag = 10.0;
  run(sim, 6.0);
  const auto height = [&](Index i) { return sim.state.position[i].y; };
  EXPECT_NEAR(height(5) - height(1), thickness, 1e-6);
  // the outer spring at each end of the middle one [N], upwards
  const auto lift = [&](Index nail, Index point) {
    const Vec3 d = sim.state.position[nail] - sim.state.position[point];
    const double length = glm::length(d);
    return k * (length - a) * d.y / length;
  };
  const double load = 2.0 * 3.0 * m * g - lift(4, 5) - lift(7, 6), carried = lift(0, 1) + lift(3, 2) - 2.0 * m * g;
  EXPECT_GT(load, 0.3);
  EXPECT_NEAR(carried, load, 1e-3 * load);
  for (const Vec3& v : sim.state.velocity) EXPECT_LT(glm::length(v), 1e-5);
}

}  // namespace
}  // namespace hooke
