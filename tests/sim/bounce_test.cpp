// Impacts: their times, heights and directions, and the state of rest afterwards.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "sim/contact/gap.h"
#include "support/convergence.h"
#include "support/fall.h"
#include "support/nets.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// A ball of radius 0.05 m released at `height` above a floor at y = -1.
TestSim falling_ball(double height, double restitution, double radius = 0.05) {
  TestSim sim;
  sim.add({0.2, -1.0 + radius + height, 0.1});
  sim.system.point(0).radius = radius;
  sim.system.colliders = {{.shape = Plane{.point = {0.0, -1.0, 0.0}}, .restitution = restitution}};
  return sim;
}

// Height above the floor and velocity at time t: flights of 2 e^n v0 / g after the first impact at v0 = sqrt(2 g h).
struct Bouncing {
  double height, velocity;
  Bouncing(double drop_height, double restitution, double t) {
    double rebound = std::sqrt(2.0 * g * drop_height), left = t - rebound / g;
    if (left < 0.0) {
      height = drop_height - 0.5 * g * t * t;
      velocity = -g * t;
      return;
    }
    rebound *= restitution;
    while (rebound > 1e-9 && left > 2.0 * rebound / g) {
      left -= 2.0 * rebound / g;
      rebound *= restitution;
    }
    height = rebound > 1e-9 ? left * (rebound - 0.5 * g * left) : 0.0;
    velocity = rebound > 1e-9 ? rebound - g * left : 0.0;
  }
};

class Bounce : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Bounce, testing::ValuesIn(every_method()), method_name);

TEST(Bounce, IsExactThroughManyImpactsAtOneSubstepPerFrame) {
  const Integrator& verlet = *find_integrator("velocity_verlet");
  for (const double restitution : {0.5, 0.8, 0.95}) {
    TestSim sim = falling_ball(1.0, restitution);
    for (int i = 1; i <= 130; ++i) {
      sim.run(verlet, frame_time, 1);
      const Bouncing exact(1.0, restitution, i * frame_time);
      EXPECT_NEAR(sim.state.position[0].y, -0.95 + exact.height, 1e-9) << "e = " << restitution << ", frame " << i;
      EXPECT_NEAR(sim.state.velocity[0].y, exact.velocity, 1e-8) << "e = " << restitution << ", frame " << i;
    }
  }
}

// during the flight after the third impact, at t1 (1 + 2 e + 2 e^2); the error of the Euler methods is g h t / 2, as in free fall
TEST_P(Bounce, MeetsTheOrderOfTheMethodAfterTheThirdImpact) {
  const double e = 0.8, t1 = std::sqrt(2.0 / g), t = t1 * (1.0 + 2.0 * e + 2.0 * e * e + 0.6 * e * e * e);
  const auto error = [&](int steps) {
    TestSim sim = falling_ball(1.0, e);
    sim.run(method(), t, steps);
    return std::abs(sim.state.position[0].y + 0.95 - Bouncing(1.0, e, t).height);
  };
  if (method().order == 1) {
    expect_order(error, 2000, 1.0);
  } else {
    EXPECT_LT(error(97), 1e-9);
  }
}

// y(t) = y + v t for free fall with drag c: v' = -g - c v.
struct Falling {
  double drag, height, velocity;
  double v(double t) const { return -g / drag + (velocity + g / drag) * std::exp(-drag * t); }
  double y(double t) const { return height - g / drag * t - (velocity + g / drag) * std::expm1(-drag * t) / drag; }
};

// Bounces under drag, from random heights: HOOKE_SEED sets the sequence.
TEST(Bounce, UnderDragIsOfSecondOrder) {
  const char* seed = std::getenv("HOOKE_SEED");
  Random random(seed != nullptr ? std::strtoull(seed, nullptr, 10) : 1);
  for (int i = 0; i < 50; ++i) {
    const double drag = random.uniform(0.2, 10.0), height = random.uniform(0.05, 1.0), e = random.uniform(0.3, 1.0);
    const Falling fall{drag, height, 0.0};
    double before = 0.0, after = 5.0;
    for (int k = 0; k < 100; ++k) (fall.y(0.5 * (before + after)) < 0.0 ? after : before) = 0.5 * (before + after);
    const Falling rise{drag, 0.0, -e * fall.v(before)};
    const double left = 0.3 * rise.velocity / (g + drag * rise.velocity), seconds = before + left;
    for (const char* id : {"velocity_verlet", "blanes_moan4", "runge_kutta4", "implicit_midpoint"}) {
      TestSim sim = falling_ball(height, e);
      sim.system.drag = drag;
      constexpr int steps = 100;
      sim.run(*find_integrator(id), seconds, steps);
      const double h = seconds / steps, largest = drag * h * drag * h * std::abs(fall.v(before)) * left + g * drag * h * h * seconds;
      EXPECT_NEAR(sim.state.position[0].y + 0.95, rise.y(left), largest) << id << " drag " << drag << " height " << height << " e " << e;
    }
  }
}

// Two masses joined by a spring and a dashpot, of which one hits the floor: the impact changes the force on both.
TEST_P(Bounce, UnderADashpotMeetsTheOrderDeclaredForContact) {
  constexpr int heights = 100;
  const auto fallen = [](double height, const Integrator& by, int steps, std::optional<double> tolerance) {
    TestSim sim;
    sim.join(sim.add({0.0, height, 0.0}, 0.5), sim.add({0.2, height + 0.3, 0.0}), 60.0, 0.35, 2.0);
    sim.system.colliders = {{.shape = Plane{}, .restitution = 0.7}};
    tolerance ? sim.run(by, 0.3, steps, *tolerance) : sim.run(by, 0.3, steps);
    return sim.state;
  };
  std::vector<State> exact;
  for (int k = 0; k < heights; ++k) exact.push_back(fallen(0.2 + 0.001 * k, *find_integrator("dop853"), 10, 1e-11));
  const auto error = [&](int steps) {
    double sum = 0.0;
    for (int k = 0; k < heights; ++k) sum += std::pow(distance(exact[k], fallen(0.2 + 0.001 * k, method(), steps, {})), 2);
    return std::sqrt(sum);
  };
  const int order = std::min(method().order_with.contact, method().order_with.damped);
  expect_order(error, order == 1 ? 400 : 100, order, 0.15);
}

// The displacement in a step as short as such a tolerance asks for has lost most of its digits. HOOKE_SEED sets the sequence.
TEST(Bounce, WithATightToleranceAgreesWithALooserOne) {
  const char* seed = std::getenv("HOOKE_SEED");
  Random random(seed != nullptr ? std::strtoull(seed, nullptr, 10) : 1);
  for (int i = 0; i < 20; ++i) {
    TestSim sim;
    const PointId first = sim.add({0.3, random.uniform(0.3, 0.6), 0.0}), second = sim.add({random.uniform(0.3, 0.5), 0.7, 0.0});
    sim.join(first, second, random.uniform(100.0, 1000.0), 0.3);
    const Vec3 normal = glm::normalize(Vec3(random.uniform(-0.3, 0.3), 1.0, 0.0));
    sim.system.colliders = {{.shape = Plane{.normal = normal}, .restitution = random.uniform(0.3, 1.0)}};
    const auto after = [&](double tolerance) {
      TestSim run = sim;
      for (int frame = 0; frame < 50; ++frame) run.run(*find_integrator("dop853"), 1.0 / 60.0, 20, tolerance);
      return run.state;
    };
    EXPECT_LT(distance(after(1e-9), after(1e-12)), 1e-6) << "scene " << i;
  }
}

// A mass hanging from a spring hits the floor at the height where the spring has its rest length: y = y_eq + A cos(w t) + B sin(w t)
// between impacts, y_eq = -g / w^2. The error depends on where in its step an impact falls, so the error is averaged over many drop
// heights.
TEST_P(Bounce, WithASpringMeetsTheOrderDeclaredForContact) {
  const double m = 0.5, w = 6.0, e = 0.7, seconds = 0.3, rest = -g / (w * w);
  const auto error = [&](int steps) {
    double sum = 0.0;
    for (double height = 0.3; height < 0.5; height += 0.002) {
      TestSim sim;
      const PointId mass = sim.add({0.0, height, 0.0}, m);
      sim.join(mass, sim.nail({0.0, 1.0, 0.0}), m * w * w, 1.0);
      sim.system.colliders = {{.shape = Plane{}, .restitution = e}};
      sim.run(method(), seconds, steps);

      const double fall = std::acos(-rest / (height - rest)) / w, speed = (height - rest) * w * std::sin(w * fall);
      const double exact = rest - rest * std::cos(w * (seconds - fall)) + e * speed / w * std::sin(w * (seconds - fall));
      EXPECT_GT(exact, 0.0);
      sum += std::pow(sim.position(mass).y - exact, 2);
    }
    return std::sqrt(sum);
  };
  expect_order(error, method().order_with.contact == 1 ? 400 : 100, method().order_with.contact, 0.1);
}

// t1 (1 + e) / (1 - e): at rest at the end of the frame that contains this time, and not before
TEST(Bounce, EndsAtTheSumOfTheGeometricSeries) {
  const Integrator& verlet = *find_integrator("velocity_verlet");
  for (const double e : {0.0, 0.3, 0.5, 0.9, 0.97}) {
    TestSim sim = falling_ball(0.5, e);
    const int frames = static_cast<int>(std::ceil(std::sqrt(1.0 / g) * (1.0 + e) / (1.0 - e) / frame_time));
    for (int i = 1; i < frames; ++i) {
      sim.run(verlet, frame_time, 1);
      ASSERT_NE(sim.state.velocity[0].y, 0.0) << "e = " << e << ", frame " << i << " of " << frames;
    }
    sim.run(verlet, frame_time, 1);
    EXPECT_EQ(sim.state.velocity[0].y, 0.0) << "e = " << e;
    EXPECT_NEAR(sim.state.position[0].y, -0.95, 1e-13) << "e = " << e;
  }
}

TEST_P(Bounce, EndsAtRestUnderEveryMethod) {
  for (const double e : {0.0, 0.5, 0.9})
    for (const int substeps : {1, 20}) {
      TestSim sim = falling_ball(0.1, e);
      const double rest = std::sqrt(0.2 / g) * (1.0 + e) / (1.0 - e);
      for (int i = 0; i * frame_time < 1.2 * rest + 5.0 * frame_time; ++i) sim.run(method(), frame_time, substeps);
      EXPECT_EQ(sim.state.velocity[0].y, 0.0) << "e = " << e << ", " << substeps << " substeps";
      EXPECT_NEAR(sim.state.position[0].y, -0.95, 1e-13) << "e = " << e << ", " << substeps << " substeps";
    }
}

TEST(Bounce, WithRestitutionOneKeepsItsHeightForAThousandImpacts) {
  TestSim sim = falling_ball(0.05, 1.0);
  sim.system.drag = 0.0;
  const int frames = static_cast<int>(2000.0 * std::sqrt(0.1 / g) / frame_time);
  for (int i = 0; i < frames; ++i) sim.run(*find_integrator("velocity_verlet"), frame_time, 1);
  const double height = sim.state.position[0].y + 0.95 + 0.5 * sim.state.velocity[0].y * sim.state.velocity[0].y / g;
  EXPECT_NEAR(height, 0.05, 1e-9);
}

// symplectic Euler's positions are those of Verlet and its velocities are half a step off: nothing is lost from impact to impact
TEST(Bounce, WithRestitutionOneNeitherGrowsNorDecaysUnderSymplecticEuler) {
  TestSim sim = falling_ball(0.05, 1.0);
  const int frames = static_cast<int>(2000.0 * std::sqrt(0.1 / g) / frame_time);
  for (int i = 0; i < frames; ++i) sim.run(*find_integrator("symplectic_euler"), frame_time, 4);
  const double height = sim.state.position[0].y + 0.95 + 0.5 * sim.state.velocity[0].y * sim.state.velocity[0].y / g;
  // the error of v is g h / 2
  EXPECT_NEAR(height, 0.05, std::sqrt(2.0 * g * 0.05) * frame_time / 4.0);
}

TEST(Bounce, AtHighSpeedReboundsToTheSquareOfRestitution) {
  TestSim sim = falling_ball(0.0, 0.7);
  sim.state.position[0].y += 3.0;
  sim.state.velocity[0].y = -100.0;
  double highest = -1.0;
  for (int i = 0; i < 600; ++i) {
    sim.run(*find_integrator("velocity_verlet"), frame_time, 1);
    if (sim.state.velocity[0].y > 0.0) highest = sim.state.position[0].y + 0.5 * std::pow(sim.state.velocity[0].y, 2) / g;
    if (i > 10) break;
  }
  EXPECT_NEAR(highest + 0.95, 0.49 * (1e4 + 2.0 * g * 3.0) / (2.0 * g), 1e-9);
}

// Coulomb: the tangential velocity falls by mu (1 + e) |v_n|, at most to zero
TEST(Bounce, LosesTangentialSpeedToFriction) {
  for (const double friction : {0.1, 5.0}) {
    TestSim sim = falling_ball(0.0, 0.5);
    sim.system.gravity = Vec3(0.0);
    sim.system.colliders[0].friction = friction;
    sim.state.position[0].y += 0.01;
    sim.state.velocity[0] = {3.0, -4.0, 4.0};
    sim.run(*find_integrator("velocity_verlet"), frame_time, 1);
    const double left = std::max(0.0, 5.0 - friction * 1.5 * 4.0) / 5.0;
    EXPECT_LT(glm::distance(sim.state.velocity[0], Vec3(3.0 * left, 2.0, 4.0 * left)), 1e-12) << "mu = " << friction;
  }
}

// A point moving at 100 m/s past a sphere at distance b from its center is reflected at the point of impact, even at grazing incidence.
TEST_P(Bounce, OffABallIsAReflectionAtAnyImpactParameter) {
  const double combined_radius = 0.3;
  for (const double radius : {0.0, 0.1})
    for (const double b : {0.0, 0.1, 0.5, 0.9, 0.99, 0.9999}) {
      TestSim sim;
      sim.system.gravity = Vec3(0.0);
      sim.system.colliders = {{.shape = Sphere{.center = {0.1, 0.2, 0.3}, .radius = combined_radius - radius}, .restitution = 1.0}};
      sim.add(Vec3(0.1 - 0.8, 0.2 + b * combined_radius, 0.3), 1.0, {100.0, 0.0, 0.0});
      sim.system.point(0).radius = radius;
      sim.run(method(), frame_time, 1);

      const double cosine = std::sqrt(1.0 - b * b), path_length = 0.8 - combined_radius * cosine;
      const Vec3 normal(-cosine, b, 0.0), out = Vec3(1.0, 0.0, 0.0) - 2.0 * -cosine * normal;
      const Vec3 expected = Vec3(0.1, 0.2, 0.3) + combined_radius * normal + (100.0 * frame_time - path_length) * out;
      EXPECT_LT(glm::distance(sim.state.position[0], expected), 1e-9 / std::max(cosine, 0.01)) << "b = " << b << ", radius " << radius;
      EXPECT_LT(glm::distance(sim.state.velocity[0], 100.0 * out), 1e-8 / std::max(cosine, 0.01)) << "b = " << b;
    }
}

TEST(Bounce, RequiresContact) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.colliders = {{.shape = Sphere{.center = Vec3(0.0), .radius = 0.3}, .restitution = 1.0}};
  sim.add(Vec3(-0.8, 0.3 + 1e-9, 0.0), 1.0, {100.0, 0.0, 0.0});
  sim.run(*find_integrator("velocity_verlet"), frame_time, 1);
  EXPECT_EQ(sim.state.velocity[0], Vec3(100.0, 0.0, 0.0));
}

// A box of 2 m with walls of 1 mm that contains a ball and a block. Points moving at 100 m/s must stay inside the box and outside the ball
// and the block.
TestSim closed_box(double restitution) {
  TestSim sim;
  const auto box = [&](const Vec3& min, const Vec3& max) {
    sim.system.colliders.push_back({.shape = Box{min, max}, .restitution = restitution});
  };
  const double w = 1.001;
  for (int c = 0; c < 3; ++c)
    for (const double side : {-1.0, 1.0}) {
      Vec3 min(-w), max(w);
      min[c] = side > 0.0 ? 1.0 : -w;
      max[c] = side > 0.0 ? w : -1.0;
      box(min, max);
    }
  sim.system.colliders.push_back({.shape = Sphere{.center = {0.3, 0.0, 0.0}, .radius = 0.3}, .restitution = restitution});
  box({-0.8, -1.0, -0.5}, {-0.5, -0.2, 0.5});
  sim.system.colliders.push_back({.shape = Plane{.point = {0.0, -0.9, 0.0}}, .restitution = restitution});
  return sim;
}

TEST_P(Bounce, NothingPassesThroughWallsAtAHundredMetersPerSecond) {
  Random random(5);
  for (const double restitution : {0.0, 0.6, 1.0}) {
    TestSim sim = closed_box(restitution);
    for (int i = 0; i < 100; ++i) {
      const Vec3 direction = glm::normalize(Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)));
      sim.add({-0.2, 0.3, random.uniform(-0.3, 0.3)}, 1.0, 100.0 * direction);
      sim.system.point(i).radius = i % 2 == 0 ? 0.0 : 0.03;
    }
    for (int f = 0; f < 60; ++f) {
      sim.run(method(), frame_time, 1);
      for (std::size_t i = 0; i < sim.state.position.size(); ++i) {
        const Vec3& x = sim.state.position[i];
        ASSERT_LT(std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}), 1.0 + 1e-12) << "point " << i << ", frame " << f;
        for (const Collider& collider : sim.system.colliders)
          ASSERT_GT(gap_to(collider, sim.system.points()[i].radius, x).distance, -1e-12) << "point " << i << ", frame " << f;
      }
    }
  }
}

}  // namespace
}  // namespace hooke
