// Sliding, sticking and resting on planes, balls and blocks, and where two of them meet.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/gap.h"
#include "sim/forces/energy/energy.h"
#include "sim/methods/rows.h"
#include "support/convergence.h"
#include "support/fall.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// A point on a plane through the origin that slopes down towards +x at `angle`; `down` is the direction of sliding.
struct Incline {
  TestSim sim;
  Vec3 down;
  Incline(double angle, double friction, double speed_down, double restitution = 0.0) : down(std::cos(angle), -std::sin(angle), 0.0) {
    const Vec3 normal(std::sin(angle), std::cos(angle), 0.0);
    sim.system.colliders = {{.shape = Plane{.point = Vec3(0.0), .normal = normal}, .restitution = restitution, .friction = friction}};
    sim.add(0.02 * normal, 0.3, speed_down * down);
    sim.system.point(0).radius = 0.02;
  }
  double displacement() const { return glm::dot(sim.state.position[0], down); }
  double speed() const { return glm::dot(sim.state.velocity[0], down); }
  double gap() const { return gap_to(sim.system.colliders[0], 0.02, sim.state.position[0]).distance; }
};

class Slide : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Slide, testing::ValuesIn(every_method()), method_name);

TEST_P(Slide, SticksUpToTheFrictionAngleAndNotBeyond) {
  for (const double angle : {0.1, 0.5, 1.2}) {
    Incline sticks(angle, std::tan(angle) * (1.0 + 1e-9), 0.0);
    Incline slips(angle, std::tan(angle) * (1.0 - 1e-6), 0.0);
    const Vec3 start = sticks.sim.state.position[0];
    for (int i = 0; i < 60; ++i) {
      sticks.sim.run(method(), frame_time, 3);
      slips.sim.run(method(), frame_time, 3);
    }
    EXPECT_EQ(sticks.sim.state.position[0], start) << "angle " << angle;
    EXPECT_EQ(sticks.sim.state.velocity[0], Vec3(0.0)) << "angle " << angle;
    EXPECT_GT(slips.displacement(), 0.0) << "angle " << angle;
  }
}

// s = v0 t + g (sin a - mu cos a) t^2 / 2, exactly with friction; without friction, to the accuracy of the method in free fall
TEST_P(Slide, DownAnInclineFollowsTheClosedForm) {
  const double angle = 0.7, v0 = 0.5, seconds = 1.0;
  for (const double friction : {0.3, 0.0}) {
    const double a = g * (std::sin(angle) - friction * std::cos(angle));
    const auto error = [&](int steps) {
      Incline incline(angle, friction, v0);
      incline.sim.run(method(), seconds, steps);
      EXPECT_NEAR(incline.speed(), v0 + a * seconds, 1e-11);
      EXPECT_NEAR(incline.gap(), 0.0, 1e-13);
      return std::abs(incline.displacement() - v0 * seconds - 0.5 * a * seconds * seconds);
    };
    // symplectic Euler keeps its own path under friction, too
    if (method().order == 1 && (friction == 0.0 || method().is_symplectic())) {
      expect_order(error, 500, 1.0);
    } else {
      EXPECT_LT(error(60), 1e-12);
    }
  }
}

// uphill: stops after v0 / (g (sin a + mu cos a)); stays there below the friction angle, otherwise slides back
TEST(Slide, UphillStopsAndStaysOrSlidesBack) {
  const double angle = 0.4, v0 = 2.0, sine = std::sin(angle), cosine = std::cos(angle);
  for (const double friction : {0.6, 0.2}) {
    Incline incline(angle, friction, -v0);
    for (int i = 0; i < 60; ++i) incline.sim.run(velocity_verlet, frame_time, 1);
    const double slowing = g * (sine + friction * cosine), top = -0.5 * v0 * v0 / slowing, left = 1.0 - v0 / slowing;
    const double back = std::max(0.0, g * (sine - friction * cosine));
    EXPECT_NEAR(incline.displacement(), top + 0.5 * back * left * left, 1e-12) << "mu = " << friction;
    EXPECT_NEAR(incline.speed(), back * left, 1e-12) << "mu = " << friction;
  }
}

// v0^2 / (2 mu g)
TEST_P(Slide, OnAHorizontalPlaneStopsAfterTheStoppingDistance) {
  for (const double friction : {0.1, 0.5, 2.0})
    for (const int substeps : {1, 7}) {
      Incline flat(0.0, friction, 3.0);
      for (int i = 0; i < 240; ++i) flat.sim.run(method(), frame_time, substeps);
      // symplectic Euler's own path is up to half a step ahead
      const double ahead = method().is_symplectic() ? std::abs(method().velocity_lag) * 3.0 * frame_time / substeps : 0.0;
      EXPECT_NEAR(flat.displacement(), 9.0 / (2.0 * friction * g), ahead + 1e-11) << "mu = " << friction;
      EXPECT_EQ(flat.sim.state.velocity[0], Vec3(0.0)) << "mu = " << friction;
    }
}

// a surface without friction does not affect the motion along it, including forces
TEST_P(Slide, WithoutFrictionMovesAsIfThePlaneWereAbsent) {
  const auto swinging = [&](bool on_plane, int steps = 600) {
    TestSim sim;
    const PointId point = sim.add({0.5, 0.0, 0.2}, 0.5, {0.0, 0.0, 1.0});
    sim.join(point, sim.nail({0.0, 0.0, 0.0}), 60.0, 0.3, 0.2);
    if (on_plane)
      sim.system.colliders = {{.shape = Plane{}}};
    else
      sim.system.gravity = Vec3(0.0);
    sim.run(method(), 1.0, steps);
    return sim.state.position[0];
  };
  // the forces within a step are evaluated up to y = g h^2 below the plane, where the spring is y^2 / 2l longer
  const double below = g / 360000.0;
  double bound = 0.5 * 60.0 / 0.5 * below * below / 0.5;
  // a method that keeps the acceleration of the step before starts anew after contact: a part of its own error
  if (method().amplification({.h_lambda = 0.1}).third != 0.0) bound = glm::distance(swinging(false), swinging(false, 1200));
  EXPECT_LT(glm::distance(swinging(true), swinging(false)), bound);
}

class Rest : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Rest, testing::ValuesIn(every_method()), method_name);

TEST_P(Rest, LastsTenThousandFrames) {
  for (const double restitution : {0.0, 0.5, 0.9, 1.0}) {
    std::vector<TestSim> sims;
    sims.push_back(Incline(0.0, 0.0, 0.0, restitution).sim);
    sims.push_back(Incline(0.3, 0.4, 0.0, restitution).sim);

    // on top of a ball and of a block, and in a groove
    for (const auto& shape : {std::variant<Plane, Sphere, Box>(Sphere{.center = {0.0, -0.52, 0.0}, .radius = 0.5}),
                              std::variant<Plane, Sphere, Box>(Box{.min = {-1.0, -1.0, -1.0}, .max = {1.0, -0.02, 1.0}})}) {
      TestSim sim;
      sim.add(Vec3(0.0));
      sim.system.point(0).radius = 0.02;
      sim.system.colliders = {{.shape = shape, .restitution = restitution, .friction = 0.1}};
      sims.push_back(sim);
    }
    TestSim groove;
    groove.add(Vec3(0.0, 0.02 * std::sqrt(2.0), 0.0));
    groove.system.point(0).radius = 0.02;
    for (const double side : {-1.0, 1.0})
      groove.system.colliders.push_back({.shape = Plane{.normal = glm::normalize(Vec3(side, 1.0, 0.0))}, .restitution = restitution});
    sims.push_back(groove);

    for (std::size_t which = 0; which < sims.size(); ++which) {
      TestSim& sim = sims[which];
      const Vec3 start = sim.state.position[0];
      for (int i = 0; i < 10000; i += 20) sim.run(method(), 20.0 * frame_time, 20);
      EXPECT_LT(glm::distance(sim.state.position[0], start), 1e-12) << "scene " << which << ", e = " << restitution;
      EXPECT_EQ(sim.state.velocity[0], Vec3(0.0)) << "scene " << which << ", e = " << restitution;
    }
  }
}

// pressed against the floor by a spring: no penetration, whatever the force of the spring
TEST_P(Rest, UnderASpringIsOnTheFloor) {
  for (const double stiffness : {1.0, 1e3, 1e5}) {
    TestSim sim;
    sim.system.drag = 30.0;
    const PointId point = sim.add({0.0, 0.3, 0.0}, 1.0);
    sim.join(point, sim.nail({0.0, 1.0, 0.0}), stiffness, 1.5);
    sim.system.colliders = {{.shape = Plane{}, .restitution = 0.3, .friction = 0.2}};
    for (int i = 0; i < 60; ++i) sim.run(method(), frame_time, 200);
    EXPECT_NEAR(sim.position(point).y, 0.0, 1e-13) << "k = " << stiffness;
    EXPECT_EQ(sim.velocity(point).y, 0.0) << "k = " << stiffness;
  }
}

// The normal force is that of the weight and the spring; friction holds up to mu times their sum. The forces of a step are evaluated up to
// g h^2 below the floor, where that of the spring is off by k h^2 / m = 1e-3.
TEST_P(Rest, FrictionIncludesTheForceOfTheSpring) {
  const double m = 0.5, k = 200.0, friction = 0.4;
  for (const double factor : {0.998, 1.002})
    for (const double squeezed : {0.0, 0.3}) {
      TestSim sim;
      const PointId point = sim.add(Vec3(0.0), m);
      sim.join(point, sim.nail({0.0, 1.0, 0.0}), k, 1.0 + squeezed);
      sim.system.colliders = {{.shape = Plane{}, .friction = friction}};
      sim.system.gravity.x = factor * friction * (g + k * squeezed / m);
      sim.run(method(), 0.05, 30);
      if (factor < 1.0) {
        EXPECT_EQ(sim.position(point), Vec3(0.0)) << "squeezed by " << squeezed;
      } else {
        EXPECT_GT(sim.position(point).x, 0.0) << "squeezed by " << squeezed;
      }
    }
}

// A point released from rest on a ball of radius R, `angle` from the top, without friction.
TestSim on_ball(double angle, double radius, double friction = 0.0) {
  TestSim sim;
  sim.add(Vec3(std::sin(angle), std::cos(angle), 0.0) * radius);
  sim.system.colliders = {{.shape = Sphere{.center = Vec3(0.0), .radius = radius}, .restitution = 0.5, .friction = friction}};
  return sim;
}

// the point leaves where the cosine is 2/3 of its initial value, within the angle of one step
TEST_P(Slide, DownABallLosesContactAtTwoThirds) {
  const double radius = 0.5, start = 0.05;
  for (const int substeps : {1, 10, 100}) {
    TestSim sim = on_ball(start, radius);
    const double h = frame_time / substeps;
    double cosine = 1.0, speed = 0.0;
    for (int i = 0; i < 120 * substeps; ++i) {
      sim.run(method(), h, 1);
      const double distance = glm::length(sim.state.position[0]) / radius;
      if (distance > 1.0 + 1e-12) break;
      EXPECT_NEAR(distance, 1.0, 1e-12);
      cosine = sim.state.position[0].y / radius;
      speed = glm::length(sim.state.velocity[0]);
    }
    const double turned = speed * h / radius;
    EXPECT_NEAR(cosine, 2.0 / 3.0 * std::cos(start), 2.0 * turned) << substeps << " substeps";
    EXPECT_LT(cosine, 0.9) << substeps << " substeps";
  }
}

// v^2 = 2 g R (cos a0 - cos a): second order in the step
TEST(Slide, DownABallConservesEnergyToSecondOrder) {
  const auto error = [&](int steps) {
    TestSim sim = on_ball(0.2, 0.5);
    const double start = compute_energy(sim.system, sim.state).total();
    sim.run(velocity_verlet, 0.35, steps);
    EXPECT_NEAR(glm::length(sim.state.position[0]), 0.5, 1e-12);
    return std::abs(compute_energy(sim.system, sim.state).total() - start);
  };
  expect_order(error, 100, 2.0);
}

TEST(Slide, DownABallWithFrictionConverges) {
  const auto end = [&](int steps) {
    TestSim sim = on_ball(0.5, 0.5, 0.2);
    sim.run(velocity_verlet, 0.3, steps);
    EXPECT_NEAR(glm::length(sim.state.position[0]), 0.5, 1e-12);
    return sim.state.position[0];
  };
  const Vec3 coarse = end(50), middle = end(100), fine = end(200);
  EXPECT_NEAR(std::log2(glm::distance(coarse, middle) / glm::distance(middle, fine)), 2.0, 0.15);
}

TEST(Slide, OnABallSticksUpToTheFrictionAngle) {
  TestSim sticks = on_ball(0.5, 0.5, std::tan(0.5) * 1.000001), slips = on_ball(0.5, 0.5, std::tan(0.5) * 0.999);
  const Vec3 start = sticks.state.position[0];
  sticks.run(velocity_verlet, 1.0, 60);
  slips.run(velocity_verlet, 1.0, 60);
  EXPECT_EQ(sticks.state.position[0], start);
  EXPECT_GT(glm::distance(slips.state.position[0], start), 1e-4);
}

// on a ball of 1 mm the path turns by more than a right angle in one step
TEST_P(Slide, DownATinyBallIsFinite) {
  TestSim sim = on_ball(0.01, 1e-3);
  for (int i = 0; i < 120; ++i) {
    sim.run(method(), frame_time, 1);
    ASSERT_GT(glm::length(sim.state.position[0]), 1e-3 - 1e-13);
  }
  EXPECT_LT(sim.state.position[0].y, -1.0);
}

// off a table: a parabola from the edge, to within the step in which the point leaves
TEST_P(Slide, OffATableFalls) {
  const double v0 = 2.0, seconds = 0.5, edge = 0.3;
  const auto distance = [&](int steps) {
    TestSim sim;
    sim.add(Vec3(0.0), 1.0, {v0, 0.0, 0.0});
    sim.system.colliders = {{.shape = Box{.min = {-1.0, -0.1, -1.0}, .max = {edge, 0.0, 1.0}}}};
    sim.run(method(), seconds, steps);
    const double falling = seconds - edge / v0;
    return glm::distance(sim.state.position[0], Vec3(v0 * seconds, -0.5 * g * falling * falling, 0.0));
  };
  for (const int steps : {30, 300}) EXPECT_LT(distance(steps), 2.0 * g * seconds * seconds / steps) << steps << " steps";
}

TEST_P(Slide, OffATableWithARadiusFallsAroundTheEdge) {
  TestSim sim;
  sim.add({0.0, 0.05, 0.0}, 1.0, {0.3, 0.0, 0.0});
  sim.system.point(0).radius = 0.05;
  sim.system.colliders = {{.shape = Box{.min = {-1.0, -0.1, -1.0}, .max = {0.1, 0.0, 1.0}}, .restitution = 0.5}};
  for (int i = 0; i < 60; ++i) {
    sim.run(method(), frame_time, 4);
    ASSERT_GT(gap_to(sim.system.colliders[0], 0.05, sim.state.position[0]).distance, -1e-12);
  }
  EXPECT_LT(sim.state.position[0].y, -1.0);
}

// where flights and impacts alternate on the edge
TEST_P(Slide, OffATableWithARadiusConverges) {
  const auto end = [](const Integrator& by, int steps) {
    TestSim sim;
    sim.add({0.06, 0.04, 0.0}, 1.0, {0.3, 0.0, 0.0});
    sim.system.point(0).radius = 0.04;
    sim.system.colliders = {{.shape = Box{.min = {-1.0, -0.2, -1.0}, .max = {0.1, 0.0, 1.0}}}};
    sim.run(by, 0.4, steps);
    return sim.state.position[0];
  };
  const Vec3 reference = end(*find_integrator("velocity_verlet"), 100'000);
  EXPECT_LT(glm::distance(end(method(), 4000), reference), 2e-4);
  EXPECT_LT(glm::distance(end(method(), 32'000), reference), 4e-5);
}

// a lifted point leaves as if there were no floor; the first step of explicit Euler differs from the parabola by h^2 a / 2
TEST_P(Rest, EndsWithoutABounceWhenLifted) {
  const auto lifted = [&](bool on_floor) {
    TestSim sim;
    sim.system.gravity = {0.0, 0.5, 0.0};
    sim.add(Vec3(0.0));
    if (on_floor) sim.system.colliders = {{.shape = Plane{}, .restitution = 0.5, .friction = 0.5}};
    sim.run(method(), 0.5, 30);
    return sim.state;
  };
  EXPECT_LT(glm::distance(lifted(true).position[0], lifted(false).position[0]), method().order == 1 ? 0.25 / 3600.0 + 1e-14 : 1e-14);
  EXPECT_LT(glm::distance(lifted(true).velocity[0], lifted(false).velocity[0]), 1e-14);
}

// down a ball into the corner between the ball and a floor
TEST_P(Slide, DownABallOntoAFloorEndsInTheCorner) {
  TestSim sim = on_ball(0.2, 0.5, 0.05);
  sim.system.colliders.push_back({.shape = Plane{.point = {0.0, 0.4, 0.0}}, .friction = 0.5});
  sim.system.colliders.push_back({.shape = Plane{.point = {0.35, 0.0, 0.0}, .normal = {-1.0, 0.0, 0.0}}, .friction = 0.5});
  for (int i = 0; i < 180; ++i) {
    sim.run(method(), frame_time, 1);
    for (const Collider& collider : sim.system.colliders)
      ASSERT_GT(gap_to(collider, 0.0, sim.state.position[0]).distance, -1e-13) << "frame " << i;
  }
  EXPECT_EQ(sim.state.velocity[0], Vec3(0.0));
  EXPECT_NEAR(sim.state.position[0].y, 0.4, 1e-13);
}

// A groove formed by two planes along z, each at `angle` from the vertical.
TestSim groove(double angle, double restitution, double friction) {
  TestSim sim;
  for (const double side : {-1.0, 1.0})
    sim.system.colliders.push_back(
        {.shape = Plane{.normal = {side * std::cos(angle), std::sin(angle), 0.0}}, .restitution = restitution, .friction = friction});
  return sim;
}

TEST_P(Rest, InAGrooveIsReachedFromAbove) {
  for (const double angle : {0.3, 0.8, 1.4})
    for (const double restitution : {0.0, 0.5}) {
      TestSim sim = groove(angle, restitution, 0.3);
      sim.add({0.1, 0.8, 0.0}, 1.0, {0.3, 0.0, 0.0});
      sim.system.point(0).radius = 0.05;
      for (int i = 0; i < 1200; ++i) sim.run(method(), frame_time, 1);
      for (const Collider& collider : sim.system.colliders)
        EXPECT_GT(gap_to(collider, 0.05, sim.state.position[0]).distance, -1e-12) << "angle " << angle << ", e = " << restitution;
      EXPECT_LT(glm::length(sim.state.velocity[0]), 1e-9) << "angle " << angle << ", e = " << restitution;
      // friction may hold the point on one side if the groove is shallow enough
      if (std::tan(0.5 * std::numbers::pi - angle) > 0.3) {
        EXPECT_NEAR(sim.state.position[0].y, 0.05 / std::sin(angle), 1e-9) << "angle " << angle << ", e = " << restitution;
      }
    }
}

// without friction, motion along the groove continues
TEST_P(Slide, AlongAGrooveIsUnimpeded) {
  TestSim sim = groove(0.7, 0.5, 0.0);
  sim.add({0.0, 0.05 / std::sin(0.7), 0.0}, 1.0, {0.0, 0.0, 1.5});
  sim.system.point(0).radius = 0.05;
  for (int i = 0; i < 60; ++i) sim.run(method(), frame_time, 1);
  EXPECT_LT(glm::distance(sim.state.position[0], Vec3(0.0, 0.05 / std::sin(0.7), 1.5)), 1e-12);
}

// both sides of a groove exert a normal force g / (2 sin a) per mass, and friction
TEST(Slide, AlongAGrooveIsSlowedByTheFrictionOfBothSides) {
  const double angle = 0.7, friction = 0.1, slowing = friction * g / std::sin(angle);
  TestSim sim = groove(angle, 0.0, friction);
  sim.add({0.0, 0.05 / std::sin(angle), 0.0}, 1.0, {0.0, 0.0, 1.5});
  sim.system.point(0).radius = 0.05;
  sim.run(velocity_verlet, 0.5, 30);
  EXPECT_NEAR(sim.state.position[0].z, 1.5 * 0.5 - 0.5 * slowing * 0.25, 1e-12);
}

// a wall stops a sliding point, even if the whole path is within one step
TEST_P(Slide, IntoAWallStopsAtTheWall) {
  for (const double restitution : {0.0, 0.5}) {
    TestSim sim;
    sim.add({0.0, 0.0, 0.0}, 1.0, {100.0, 0.0, 0.0});
    sim.system.colliders = {{.shape = Plane{}},
                            {.shape = Box{.min = {0.5, -1.0, -1.0}, .max = {0.501, 1.0, 1.0}}, .restitution = restitution}};
    sim.run(method(), frame_time, 1);
    const double left = frame_time - 0.5 / 100.0;
    EXPECT_NEAR(sim.state.position[0].x, 0.5 - restitution * 100.0 * left, 1e-12);
    EXPECT_NEAR(sim.state.velocity[0].x, -restitution * 100.0, 1e-10);
    EXPECT_NEAR(sim.state.position[0].y, 0.0, 1e-13);
  }
}

}  // namespace
}  // namespace hooke
