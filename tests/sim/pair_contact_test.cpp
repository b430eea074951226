// Contact between points: closed forms, conservation, rest.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/forces/energy/energy.h"
#include "support/convergence.h"
#include "support/fall.h"
#include "support/next_frame.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

const Integrator& verlet() { return default_integrator(); }

// An empty space without gravity in which points touch.
TestSim space(double restitution, double friction = 0.0) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.contact = {.points = true, .restitution = restitution, .friction = friction};
  return sim;
}

PointId add_ball(TestSim& sim, double radius, const Vec3& x, double mass = 1.0, const Vec3& v = Vec3(0.0)) {
  const PointId id = sim.add(x, mass, v);
  sim.system.point(sim.system.index_of(id)).radius = radius;
  return id;
}

double kinetic_energy(const TestSim& sim) { return compute_energy(sim.system, sim.state).kinetic; }
Momentum momentum(const TestSim& sim) { return compute_momentum(sim.system, sim.state); }

// The largest overlap of two points [m].
double max_overlap(const TestSim& sim) {
  double max = 0.0;
  for (Index i = 0; i < sim.system.point_count(); ++i)
    for (Index j = 0; j < i; ++j)
      max = std::max(max, sim.system.points()[i].radius + sim.system.points()[j].radius + sim.system.contact.thickness -
                              glm::distance(sim.state.position[i], sim.state.position[j]));
  return max;
}

// Three equal discs: the first meets the other two, which touch, in their plane of symmetry. Of the normals at 30 degrees from its path:
// v' = -v / 5, and the others leave along them with 2 sqrt(3) / 5 v. Momentum and energy are conserved.
TEST(PairContact, ImpactsAtTheSameTimeAreSolvedTogetherWhateverTheOrderOfThePoints) {
  for (const double side : {0.1, -0.1}) {
    TestSim sim = space(1.0);
    sim.system.dimensions = 2;
    const PointId first = add_ball(sim, 0.1, {0.0, 2.0, 0.0}, 1.0, {0.0, -1.0, 0.0});
    const PointId one = add_ball(sim, 0.1, {side, 0.0, 0.0}), other = add_ball(sim, 0.1, {-side, 0.0, 0.0});
    sim.run(verlet(), 3.0, 3600);
    const auto v = [&](PointId id) { return sim.state.velocity[static_cast<std::size_t>(sim.system.index_of(id))]; };
    EXPECT_NEAR(glm::distance(v(first), Vec3(0.0, 0.2, 0.0)), 0.0, 1e-12);
    const double leaving = 0.4 * std::sqrt(3.0);
    const Vec3 away(std::copysign(0.5 * leaving, side), -0.5 * std::sqrt(3.0) * leaving, 0.0);
    EXPECT_NEAR(glm::distance(v(one), away), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(v(other), Vec3(-away.x, away.y, 0.0)), 0.0, 1e-12);
  }
}

class PairContactOf : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, PairContactOf, testing::ValuesIn(every_method()), method_name);

// v1' = v1 - m2 (1 + e) (v1 - v2) / (m1 + m2) at the time at which the gap is closed
TEST_P(PairContactOf, OfTwoSpheresHeadOnIsExact) {
  for (const double e : {0.0, 0.4, 1.0}) {
    TestSim sim = space(e);
    sim.system.contact.thickness = 0.02;
    const double m1 = 0.3, m2 = 0.5, v1 = 2.0, v2 = -1.0, gap = 0.1, t = 0.1;
    const PointId first = add_ball(sim, 0.05, {0.0, 0.0, 0.0}, m1, {v1, 0.0, 0.0});
    const PointId second = add_ball(sim, 0.1, {0.17 + gap, 0.0, 0.0}, m2, {v2, 0.0, 0.0});
    sim.run(method(), t, 3);
    const double impact = gap / (v1 - v2);
    const double after1 = v1 - m2 * (1.0 + e) * (v1 - v2) / (m1 + m2), after2 = v2 + m1 * (1.0 + e) * (v1 - v2) / (m1 + m2);
    EXPECT_NEAR(sim.velocity(first).x, after1, 1e-12) << e;
    EXPECT_NEAR(sim.velocity(second).x, after2, 1e-12) << e;
    EXPECT_NEAR(sim.position(first).x, v1 * impact + after1 * (t - impact), 1e-12) << e;
    EXPECT_NEAR(sim.position(second).x, 0.17 + gap + v2 * impact + after2 * (t - impact), 1e-12) << e;
  }
}

// With the centers offset by b across the velocity, the normal is at sin(alpha) = b / (r1 + r2). Friction changes the tangential velocity
// by up to mu times the normal impulse, and stops it if less is needed.
TEST_P(PairContactOf, OfTwoSpheresObliquelyObeysCoulomb) {
  for (const double mu : {0.0, 0.2, 5.0}) {
    const double e = 0.6, m1 = 0.3, m2 = 0.5, v = 3.0, alpha = 0.5, touching = 0.15;
    TestSim sim = space(e, mu);
    const PointId first = add_ball(sim, 0.05, {-1.0, 0.0, 0.0}, m1, {v, 0.0, 0.0});
    const PointId second = add_ball(sim, 0.1, {0.0, -touching * std::sin(alpha), 0.0}, m2);
    sim.run(method(), 0.5, 5);

    const Vec3 normal(-std::cos(alpha), std::sin(alpha), 0.0), tangent(std::sin(alpha), std::cos(alpha), 0.0);
    const double weight = 1.0 / m1 + 1.0 / m2, impulse = (1.0 + e) * v * std::cos(alpha) / weight;
    const double friction = std::min(mu * impulse, v * std::sin(alpha) / weight);
    const Vec3 transferred = impulse * normal - friction * tangent;
    EXPECT_LT(glm::distance(sim.velocity(first), Vec3(v, 0.0, 0.0) + transferred / m1), 1e-11) << mu;
    EXPECT_LT(glm::distance(sim.velocity(second), -transferred / m2), 1e-11) << mu;
  }
}

TEST_P(PairContactOf, TransfersTheVelocityThroughARowOfTouchingBalls) {
  TestSim sim = space(1.0);
  add_ball(sim, 0.05, {-0.3, 0.0, 0.0}, 0.1, {2.0, 0.0, 0.0});
  for (int i = 0; i < 6; ++i) add_ball(sim, 0.05, {0.1 * i, 0.0, 0.0}, 0.1);
  sim.run(method(), 0.5, 7);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(sim.state.velocity[i].x, 0.0, 1e-12) << i;
  EXPECT_NEAR(sim.state.velocity[6].x, 2.0, 1e-12);
  EXPECT_NEAR(momentum(sim).linear.x, 0.2, 1e-15);
}

TEST_P(PairContactOf, DoesNotTunnelAtTenKilometersPerSecondInOneSubstep) {
  for (const double e : {0.0, 1.0}) {
    TestSim sim = space(e);
    const PointId bullet = add_ball(sim, 0.001, {-80.0, 0.0003, 0.0}, 0.01, {1e4, 0.0, 0.0});
    const PointId target = add_ball(sim, 0.002, {0.0, 0.0, 0.0}, 0.01);
    add_ball(sim, 0.002, {500.0, 3.0, 0.0}, 0.01);
    sim.run(method(), frame_time, 1);
    EXPECT_LT(sim.velocity(bullet).x, e == 0.0 ? 5100.0 : 1100.0);
    EXPECT_GT(sim.velocity(target).x, e == 0.0 ? 4900.0 : 8900.0);
    EXPECT_NEAR(momentum(sim).linear.x, 100.0, 1e-10);
  }
}

// of 200 balls that move freely and hit each other some hundred times
TestSim gas(double restitution, double friction) {
  TestSim sim = space(restitution, friction);
  Random random(5);
  while (sim.system.point_count() < 200) {
    const double radius = random.uniform(0.02, 0.06), mass = random.uniform(0.5, 2.0);
    const double x = random.uniform(-0.6, 0.6), y = random.uniform(-0.6, 0.6), z = random.uniform(-0.6, 0.6);
    const double u = random.uniform(-2.0, 2.0), v = random.uniform(-2.0, 2.0), w = random.uniform(-2.0, 2.0);
    add_ball(sim, radius, {x, y, z}, mass, {u, v, w});
    if (max_overlap(sim) == 0.0) continue;
    std::vector<Point> points = sim.system.points();
    points.pop_back();
    sim.system.set_points(std::move(points));
    sim.state.position.pop_back();
    sim.state.velocity.pop_back();
  }
  return sim;
}

TEST_P(PairContactOf, ConservesTheMomentumOfAGasToRounding) {
  for (const double mu : {0.0, 0.5}) {
    TestSim sim = gas(0.9, mu);
    const Momentum before = momentum(sim);
    const double energy = kinetic_energy(sim);
    sim.run(method(), 0.25, 15);
    const Momentum after = momentum(sim);
    EXPECT_LT(glm::distance(after.linear, before.linear), 1e-12);
    if (mu == 0.0) {
      EXPECT_LT(glm::distance(after.angular, before.angular), 1e-11);
    }
    EXPECT_LT(kinetic_energy(sim), 0.97 * energy);
    EXPECT_LT(max_overlap(sim), 1e-12);
  }
}

TEST_P(PairContactOf, WithoutRestitutionLossConservesTheEnergyOfAGas) {
  TestSim sim = gas(1.0, 0.0);
  const double energy = kinetic_energy(sim);
  for (int i = 0; i < 4; ++i) {
    sim.run(method(), 0.1, 3);
    EXPECT_NEAR(kinetic_energy(sim), energy, 1e-12 * energy);
  }
}

// Five balls on pairs of stiff strings: the momentum of the first appears in the last.
TEST(PairContactOfPoints, MakesNewtonsCradleSwing) {
  TestSim sim = space(1.0);
  sim.system.gravity = Vec3(0.0, -9.81, 0.0);
  const double radius = 0.05, length = 1.0, mass = 0.2, k = 1e6, lift = 0.4;
  for (int i = 0; i < 5; ++i) {
    const double angle = i == 0 ? lift : 0.0, hung = length + mass * 9.81 / k;
    const Vec3 top(2.0 * radius * i, 0.0, 0.0);
    const PointId nail = sim.nail(top);
    const PointId ball = add_ball(sim, radius, top + (i == 0 ? length : hung) * Vec3(-std::sin(angle), -std::cos(angle), 0.0), mass);
    sim.join(nail, ball, k, length);
  }
  const auto energy = [&] { return compute_energy(sim.system, sim.state).total(); };
  const double start = energy(), supplied = mass * 9.81 * length * (1.0 - std::cos(lift));
  const double speed = std::sqrt(2.0 * 9.81 * length * (1.0 - std::cos(lift)));
  double largest_last = 0.0;
  for (int i = 0; i < 52; ++i) {
    sim.run(verlet(), frame_time, 100);
    EXPECT_NEAR(energy(), start, 2e-3 * supplied) << i;
    largest_last = std::max(largest_last, sim.state.velocity[9].x);
    // between the impacts of the first quarter of the period and the third, only the last ball moves
    if (i == 40) {
      for (const int still : {1, 3, 5, 7}) EXPECT_LT(std::abs(sim.state.velocity[still].x), 0.02 * speed) << still;
      EXPECT_GT(sim.state.position[9].x, 0.4 + 0.2);
    }
  }
  EXPECT_NEAR(largest_last, speed, 0.02 * speed);
}

// A ball is thrown into a loose row; elastic balls of equal mass leave in the order of the row, each with a velocity that was there before.
TEST(PairContactOfPoints, OfABallWithARowPassesTheVelocityOn) {
  TestSim sim = space(1.0);
  add_ball(sim, 0.05, {-1.0, 0.0, 0.0}, 0.1, {3.0, 0.0, 0.0});
  for (int i = 0; i < 5; ++i) add_ball(sim, 0.05, {0.13 * i, 0.0, 0.0}, 0.1);
  const double start = kinetic_energy(sim);
  for (int i = 0; i < 60; ++i) sim.run(verlet(), frame_time, 2);
  EXPECT_NEAR(sim.state.velocity[5].x, 3.0, 1e-12);
  EXPECT_NEAR(kinetic_energy(sim), start, 1e-14);
  // the path of the last: it starts when the first has closed the gaps between all
  EXPECT_NEAR(sim.state.position[5].x, 0.52 + 3.0 * 1.0 - (0.9 + 4 * 0.03), 1e-12);
}

// Balls of `count` that fall into a box.
TestSim pile(int count, double restitution, double friction) {
  TestSim sim;
  sim.system.contact = {.points = true, .restitution = restitution, .friction = friction};
  const double wall = 0.16;
  sim.system.colliders = {{.shape = Plane{}, .restitution = restitution, .friction = friction},
                          {.shape = Plane{{-wall, 0.0, 0.0}, {1.0, 0.0, 0.0}}, .friction = friction},
                          {.shape = Plane{{wall, 0.0, 0.0}, {-1.0, 0.0, 0.0}}, .friction = friction},
                          {.shape = Plane{{0.0, 0.0, -wall}, {0.0, 0.0, 1.0}}, .friction = friction},
                          {.shape = Plane{{0.0, 0.0, wall}, {0.0, 0.0, -1.0}}, .friction = friction}};
  Random random(7);
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-0.005, 0.005), z = random.uniform(-0.005, 0.005);
    add_ball(sim, 0.03, {0.08 * (i % 4) - 0.12 + x, 0.05 + 0.07 * (i / 16), 0.08 * (i / 4 % 4) - 0.12 + z}, 0.1);
  }
  return sim;
}

TEST(PairContactOfPoints, LetsAPileComeToRestWithoutAddingEnergy) {
  for (const double friction : {0.0, 0.4}) {
    TestSim sim = pile(48, 0.3, friction);
    const auto energy = [&] { return compute_energy(sim.system, sim.state); };
    const int substeps = 6;
    const double start = energy().total(), overlap = 5.0 * 2.0 * 9.81 * std::pow(frame_time / substeps, 2);
    double lowest = start, largest_overlap = 0.0;
    for (int i = 0; i < 200; ++i) {
      sim.run(verlet(), frame_time, substeps);
      EXPECT_LT(energy().total(), lowest + 1e-12 * start) << i;
      lowest = std::min(lowest, energy().total());
      largest_overlap = std::max(largest_overlap, max_overlap(sim));
      for (const Vec3& x : sim.state.position) ASSERT_GT(x.y, 0.03 - 1e-12);
    }
    EXPECT_LT(energy().kinetic, 1e-6 * (start - lowest)) << friction;
    EXPECT_LT(largest_overlap, overlap) << friction;
  }
}

TEST(PairContactOfPoints, AccountsForTheEnergyThatImpactsRemove) {
  TestSim sim = gas(0.5, 0.3);
  const double before = kinetic_energy(sim);
  Plan plan = make_plan(sim.system);
  Frame frame_in_progress;
  frame_in_progress.begin(plan, sim.system, {.frame_rate = 5.0, .substeps = 10}, sim.state);
  while (!frame_in_progress.done()) frame_in_progress.substep(plan);
  frame_in_progress.end(plan, sim.state);
  const double change = kinetic_energy(sim) - before;
  EXPECT_LT(change, -0.1 * before);
  EXPECT_NEAR(frame_in_progress.motion().energy[EnergyCause::Contact], change, 1e-12 * before);
}

// A held point pushes a ball along: the hand supplies its energy.
TEST(PairContactOfPoints, OfAHeldPointIsWorkOfTheHand) {
  TestSim sim = space(0.0);
  const PointId held = add_ball(sim, 0.1, {0.0, 0.0, 0.0}), ball = add_ball(sim, 0.1, {0.3, 0.0, 0.0}, 0.5);
  sim.system.grab = Grab{.point = held, .kind = GrabKind::Hold};
  sim.state.hand = {.position = {0.0, 0.0, 0.0}, .target = {0.4, 0.0, 0.0}};
  const double before = compute_energy(sim.system, sim.state).total() - sim.state.supply.net_input;
  sim.run(verlet(), 0.2, 8);
  EXPECT_NEAR(sim.velocity(ball).x, 2.0, 1e-12);
  EXPECT_NEAR(sim.position(ball).x, 0.6, 1e-12);
  EXPECT_NEAR(compute_energy(sim.system, sim.state).total() - sim.state.supply.net_input, before, 1e-12);
}

TEST(PairContactOfPoints, DoesNotDependOnPointsFarAway) {
  TestSim near = gas(0.8, 0.2), both = near;
  for (int i = 0; i < 5; ++i) add_ball(both, 0.5, {50.0 + 0.9 * i, 0.0, 0.0}, 1.0, {-1.0 * i, 0.0, 0.0});
  near.run(verlet(), 0.2, 12);
  both.run(verlet(), 0.2, 12);
  for (Index i = 0; i < near.system.point_count(); ++i) EXPECT_EQ(both.state.position[i], near.state.position[i]) << i;
}

TEST(PairContactOfPoints, RepeatsWithTheSameBits) {
  const auto run = [] {
    TestSim sim = pile(32, 0.5, 0.3);
    for (int i = 0; i < 30; ++i) sim.run(verlet(), frame_time, 4);
    return sim.state;
  };
  const State first = run(), second = run();
  EXPECT_EQ(first.position, second.position);
  EXPECT_EQ(first.velocity, second.velocity);
}

// Two masses at the ends of a spring hit each other where their distance d is R: d = l0 + (d0 - l0) cos(w t), w^2 = k (1 / m1 + 1 / m2),
// and d = l0 + (R - l0) cos(w t) + e u / w sin(w t) after the impact at speed u. The error depends on where in its step the impact falls,
// so it is averaged over many starts.
TEST_P(PairContactOf, MeetsTheOrderDeclaredForContact) {
  const double m1 = 0.3, m2 = 0.5, w = 6.0, e = 0.7, seconds = 0.5, l0 = 0.5, touching = 0.3;
  const auto error = [&](int steps) {
    double sum = 0.0;
    for (double start = 0.8; start < 1.0; start += 0.001) {
      TestSim sim = space(e);
      const PointId first = add_ball(sim, 0.1, {0.0, 0.0, 0.0}, m1), second = add_ball(sim, 0.2, {0.6 * start, 0.8 * start, 0.0}, m2);
      sim.join(first, second, w * w * m1 * m2 / (m1 + m2), l0);
      sim.run(method(), seconds, steps);

      const double fall = std::acos((touching - l0) / (start - l0)) / w, speed = (start - l0) * w * std::sin(w * fall);
      const double exact = l0 + (touching - l0) * std::cos(w * (seconds - fall)) + e * speed / w * std::sin(w * (seconds - fall));
      EXPECT_GT(exact, touching);
      sum += std::pow(glm::distance(sim.position(first), sim.position(second)) - exact, 2);
    }
    return std::sqrt(sum);
  };
  expect_order(error, method().order_with.contact == 1 ? 400 : 100, method().order_with.contact, 0.1);
}

// By omega / (2 zeta + h omega) of the overlap in each substep of h, without a velocity; what separates faster is left alone.
TEST(PairContactOfPoints, RemovesOverlapsAtTheFrequencyOfContact) {
  TestSim sim = space(0.0);
  sim.system.contact.frequency = 5.0;
  sim.system.contact.damping_ratio = 10.0;
  add_ball(sim, 0.1, {0.0, 0.0, 0.0});
  add_ball(sim, 0.1, {0.15, 0.0, 0.0});
  const double h = frame_time / 4.0, omega = 2.0 * std::numbers::pi * 5.0, rate = omega / (20.0 + h * omega);
  sim.run(verlet(), 10.0 * frame_time, 40);
  EXPECT_NEAR(glm::distance(sim.state.position[0], sim.state.position[1]), 0.2 - 0.05 * std::pow(1.0 - h * rate, 40), 1e-12);
  EXPECT_EQ(sim.state.velocity[1], Vec3(0.0));
  sim.state.velocity[1] = Vec3(1.0, 0.0, 0.0);
  sim.run(verlet(), 0.5, 4);
  EXPECT_EQ(sim.state.velocity[1], Vec3(1.0, 0.0, 0.0));
}

TEST(PairContactOfPoints, IgnoresPointsJoinedAtTheirTouchingDistanceAndNoOthers) {
  TestSim sim = space(1.0);
  const PointId first = add_ball(sim, 0.1, {0.0, 0.0, 0.0}), second = add_ball(sim, 0.1, {0.25, 0.0, 0.0}, 1.0, {-1.0, 0.0, 0.0});
  const SpringId spring = sim.join(first, second, 1e-9, 0.2);
  sim.run(verlet(), 0.5, 10);
  EXPECT_NEAR(sim.velocity(second).x, -1.0, 1e-6);

  sim.state.position[1].x = 0.25 + sim.state.position[0].x;
  sim.system.spring(sim.system.index_of(spring))->rest_length = 0.21;
  sim.run(verlet(), 0.5, 10);
  EXPECT_NEAR(sim.velocity(second).x, 0.0, 1e-6);
}

// In free fall: the velocities of both change in the same way, and nothing else touches them.
TEST(PairContactOfPoints, SeparatesDeepOverlapsOfFreePointsAboutTheirCenter) {
  TestSim sim = space(0.0);
  sim.system.gravity = {0.0, -9.81, 0.0};
  add_ball(sim, 0.1, {0.0, 0.0, 0.0}, 1.0);
  add_ball(sim, 0.1, {0.15, 0.0, 0.0}, 3.0);
  const auto distance = [&] { return glm::distance(sim.state.position[0], sim.state.position[1]); };
  const auto center = [&] { return 0.25 * sim.state.position[0].x + 0.75 * sim.state.position[1].x; };
  const double before = center();
  sim.run(verlet(), 1.0, 60);
  EXPECT_GT(distance(), 0.155);
  EXPECT_NEAR(center(), before, 1e-14);
  EXPECT_EQ(sim.state.velocity[0].x, 0.0);
}

// The frame is kept from run to run, as in the laboratory.
TEST(PairContactOfPoints, OfAFrameThatIsReusedFollowsTheScene) {
  TestSim sim = space(1.0);
  add_ball(sim, 0.1, {0.0, 0.0, 0.0}, 1.0, {1.0, 0.0, 0.0});
  add_ball(sim, 0.1, {0.21, 0.0, 0.0});
  Frame reused;
  const Settings settings{.integrator = &verlet(), .substeps = 4};
  const auto run = [&](const TestSim& scene) {
    Plan plan = make_plan(scene.system);
    return next_frame(plan, reused, scene.system, settings, scene.state);
  };
  EXPECT_NEAR(run(sim).velocity[1].x, 1.0, 1e-12);
  TestSim empty = space(1.0);
  EXPECT_TRUE(run(empty).position.empty());
  EXPECT_NEAR(run(sim).velocity[1].x, 1.0, 1e-12);
}

TEST(PairContactOfPoints, WithTooManyPairsStopsTheFrameAndTheNextOneIsUnaffected) {
  TestSim crowd = space(0.0);
  for (int i = 0; i < 1500; ++i) add_ball(crowd, 10.0, {1e-3 * i, 0.0, 0.0});
  for (const char* id : {"velocity_verlet", "dop853"}) {
    Frame reused;
    const Settings settings{.integrator = find_integrator(id), .substeps = 1};
    const auto failure_of = [&](const TestSim& scene) {
      Plan plan = make_plan(scene.system);
      next_frame(plan, reused, scene.system, settings, scene.state);
      return reused.failure();
    };
    EXPECT_EQ(failure_of(crowd), StepFailure::TooManyPairs) << id;
    TestSim two = space(0.0);
    add_ball(two, 0.1, {0.0, 0.0, 0.0});
    add_ball(two, 0.1, {1.0, 0.0, 0.0});
    EXPECT_EQ(failure_of(two), StepFailure::None) << id;
  }
}

}  // namespace
}  // namespace hooke
