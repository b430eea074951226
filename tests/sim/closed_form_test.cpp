// Every method against closed forms: free fall, springs, chains, rotation. Symbols in the formulas: m mass, k stiffness, d damping, l0 rest
// length, g gravity, c drag rate.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/forces/energy/energy.h"
#include "support/convergence.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

using std::numbers::pi;

const Integrator& verlet() { return *find_integrator("velocity_verlet"); }
const Integrator& runge_kutta() { return *find_integrator("runge_kutta4"); }

class Fall : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Fall, testing::ValuesIn(every_method()), method_name);

TestSim falling_point(double drag) {
  TestSim sim;
  sim.system.gravity = {0.3, -9.81, 0.1};
  sim.system.drag = drag;
  sim.add({0.1, 2.0, -0.3}, 0.7, {1.0, 3.0, -2.0});
  return sim;
}

// v = v0 + g t for every method; x = x0 + v0 t + g t^2 / 2 exactly, except for the Euler methods, whose error is g h t / 2
TEST_P(Fall, OfAFreePointFollowsTheParabola) {
  const double seconds = 0.75;
  const int steps = 48;
  TestSim sim = falling_point(0.0);
  const State start = sim.state;
  sim.run(method(), seconds, steps);

  const Vec3 g = sim.system.gravity;
  Vec3 expected = start.position[0] + seconds * start.velocity[0] + 0.5 * seconds * seconds * g;
  if (method().order == 1) expected += (method().id == "explicit_euler" ? -0.5 : 0.5) * seconds / steps * seconds * g;
  EXPECT_LT(glm::distance(sim.state.position[0], expected), 1e-14 * steps);
  EXPECT_LT(glm::distance(sim.state.velocity[0], start.velocity[0] + seconds * g), 1e-14 * steps);
}

// v = v_inf + (v0 - v_inf) e^(-c t),  x = x0 + v_inf t + (v0 - v_inf)(1 - e^(-c t)) / c,  v_inf = wind + g / c
struct FallWithDrag {
  Vec3 position, velocity;
  FallWithDrag(const System& system, const State& start, double t) {
    const double c = system.drag;
    const Vec3 terminal = system.wind + system.gravity / c;
    velocity = terminal + std::exp(-c * t) * (start.velocity[0] - terminal);
    position = start.position[0] + t * terminal - std::expm1(-c * t) / c * (start.velocity[0] - terminal);
  }
};

TEST_P(Fall, WithDragMeetsItsOrder) {
  const double seconds = 1.3;
  const auto error = [&](int steps) {
    TestSim sim = falling_point(2.5);
    sim.system.wind = {0.0, 0.0, 4.0};
    const FallWithDrag exact(sim.system, sim.state, seconds);
    sim.run(method(), seconds, steps);
    return glm::distance(sim.state.position[0], exact.position);
  };
  expect_order(error, asymptotic_steps(method().order) / 4, method().order_with.drag);
}

TEST_P(Fall, WithDragReachesTheTerminalVelocity) {
  TestSim sim = falling_point(2.5);
  sim.system.wind = {3.0, 0.0, 0.0};
  sim.run(method(), 20.0, 1200);
  EXPECT_LT(glm::distance(sim.state.velocity[0], sim.system.wind + sim.system.gravity / 2.5), 1e-12);
}

TEST(FallWithDrag, HasTheExactVelocityAtAnyStepSize) {
  for (const char* id : {"symplectic_euler", "velocity_verlet"})
    for (const double drag : {0.01, 1.0, 50.0, 1e4})
      for (const int steps : {1, 2, 7}) {
        TestSim sim = falling_point(drag);
        const FallWithDrag exact(sim.system, sim.state, 0.5);
        sim.run(*find_integrator(id), 0.5, steps);
        EXPECT_LT(glm::distance(sim.state.velocity[0], exact.velocity), 1e-13) << id << ", c = " << drag << ", " << steps << " steps";
      }
}

// l = l0 + m g / k, for any drag and step size
TEST_P(Fall, OnASpringWithDragEndsAtEquilibrium) {
  for (const double drag : {0.5, 5.0, 50.0}) {
    TestSim sim;
    sim.system.drag = drag;
    const PointId point = sim.add({0.0, -1.3, 0.0}, 0.5);
    sim.join(sim.nail({0.0, 0.0, 0.0}), point, 40.0, 1.0);
    // explicit Euler is stable for h < c / omega^2, and for less once drag dominates
    const double h = std::min({1.0 / 60.0, 0.4 * drag / 80.0, 0.4 / drag});
    const double seconds = 60.0 * (2.0 / drag + drag / 80.0);
    sim.run(method(), seconds, static_cast<int>(seconds / h));
    EXPECT_NEAR(sim.position(point).y, -1.0 - 0.5 * 9.81 / 40.0, 1e-12) << "c = " << drag;
  }
}

TEST(FallWithDrag, OnASpringEndsAtEquilibriumAtOneSubstepPerFrame) {
  for (const char* id : {"symplectic_euler", "velocity_verlet"}) {
    TestSim sim;
    sim.system.drag = 50.0;
    const PointId point = sim.add({0.0, -1.3, 0.0}, 0.5);
    sim.join(sim.nail({0.0, 0.0, 0.0}), point, 40.0, 1.0);
    sim.run(*find_integrator(id), 60.0, 3600);
    EXPECT_NEAR(sim.position(point).y, -1.0 - 0.5 * 9.81 / 40.0, 1e-12) << id;
  }
}

// One mass attached to a nail, relative to its rest position: x'' = -w0^2 x - 2 zeta w0 x', w0 = sqrt(k / m), zeta = d / (2 sqrt(k m)).
struct DampedSpring {
  double w0, zeta, x0, v0;
  double position(double t) const {
    const double decay = std::exp(-zeta * w0 * t), b = v0 + zeta * w0 * x0;
    if (zeta < 1.0) {
      const double wd = w0 * std::sqrt(1.0 - zeta * zeta);
      return decay * (x0 * std::cos(wd * t) + b / wd * std::sin(wd * t));
    }
    if (zeta == 1.0) return decay * (x0 + b * t);
    const double root = std::sqrt(zeta * zeta - 1.0), s1 = w0 * (-zeta + root), s2 = w0 * (-zeta - root);
    const double a = (v0 - s2 * x0) / (s1 - s2);
    return a * std::exp(s1 * t) + (x0 - a) * std::exp(s2 * t);
  }
};

class SpringOnANail : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, SpringOnANail, testing::ValuesIn(every_method()), method_name);

TEST_P(SpringOnANail, FollowsTheClosedFormUndampedUnderdampedCriticallyDampedAndOverdamped) {
  const double m = 0.5, k = 50.0, w0 = 10.0, seconds = 0.83;
  for (const double zeta : {0.0, 0.2, 1.0, 2.5}) {
    const DampedSpring exact{w0, zeta, 0.1, 0.7};
    const auto error = [&](int steps) {
      TestSim sim;
      sim.system.gravity = Vec3(0.0);
      const Vec3 u(0.48, 0.6, 0.64);
      const PointId point = sim.add((1.0 + exact.x0) * u, m, exact.v0 * u);
      sim.join(sim.nail(Vec3(0.0)), point, k, 1.0, zeta * 2.0 * std::sqrt(k * m));
      sim.run(method(), seconds, steps);
      return glm::distance(sim.position(point), (1.0 + exact.position(seconds)) * u);
    };
    SCOPED_TRACE(testing::Message() << "zeta = " << zeta);
    expect_order(error, asymptotic_steps(method().order), zeta == 0.0 ? method().order : method().order_with.damped);
  }
}

// drag c instead of the dashpot: d = c m
TEST_P(SpringOnANail, FollowsTheClosedFormWithDrag) {
  const double w0 = 10.0, seconds = 0.83;
  for (const double zeta : {0.2, 1.0, 2.5}) {
    const DampedSpring exact{w0, zeta, 0.1, 0.7};
    const auto error = [&](int steps) {
      TestSim sim;
      sim.system.gravity = Vec3(0.0);
      sim.system.drag = 2.0 * zeta * w0;
      const PointId point = sim.add({1.0 + exact.x0, 0.0, 0.0}, 0.5, {exact.v0, 0.0, 0.0});
      sim.join(point, sim.nail(Vec3(0.0)), 50.0, 1.0);
      sim.run(method(), seconds, steps);
      return std::abs(sim.position(point).x - 1.0 - exact.position(seconds));
    };
    SCOPED_TRACE(testing::Message() << "zeta = " << zeta);
    expect_order(error, asymptotic_steps(method().order), method().order_with.drag);
  }
}

// the distance behaves as a damped spring with the reduced mass m1 m2 / (m1 + m2); the center of mass moves uniformly
TEST_P(SpringOnANail, BetweenTwoFreeMassesFollowsTheReducedMass) {
  const double m1 = 0.4, m2 = 1.6, reduced = m1 * m2 / (m1 + m2), k = 32.0, seconds = 0.83;
  const Vec3 drift(0.3, -0.2, 0.5);
  const DampedSpring exact{std::sqrt(k / reduced), 0.15, 0.1, 0.7};
  const auto error = [&](int steps) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId first = sim.add({0.0, 0.0, 0.0}, m1, drift - Vec3(exact.v0 * m2 / (m1 + m2), 0.0, 0.0));
    const PointId second = sim.add({1.1, 0.0, 0.0}, m2, drift + Vec3(exact.v0 * m1 / (m1 + m2), 0.0, 0.0));
    const Vec3 center = (m1 * sim.position(first) + m2 * sim.position(second)) / (m1 + m2) + seconds * drift;
    sim.join(first, second, k, 1.0, 0.15 * 2.0 * std::sqrt(k * reduced));
    sim.run(method(), seconds, steps);
    EXPECT_LT(glm::distance((m1 * sim.position(first) + m2 * sim.position(second)) / (m1 + m2), center), 1e-12);
    return std::abs(glm::distance(sim.position(first), sim.position(second)) - 1.0 - exact.position(seconds));
  };
  expect_order(error, asymptotic_steps(method().order), method().order_with.damped);
}

// Mode n of N masses along x with spacing a, between two nails or with one free end, displaced by A along `direction`.
struct Chain {
  int masses;
  bool free_end;
  double m = 0.2, k = 300.0, a = 0.1, l0 = 0.1, d = 0.0;

  // sin(n pi j / (N + 1)); with a free end sin((2n - 1) pi j / (2N + 1))
  double phase(int n) const { return free_end ? (2 * n - 1) * pi / (2 * masses + 1) : n * pi / (masses + 1); }
  double shape(int n, int j) const { return std::sin(j * phase(n)); }
  // w = 2 sqrt(k / m) sin(n pi / (2 (N + 1))), with a free end sin((2n - 1) pi / (2 (2N + 1)))
  double frequency(int n, double stiffness) const { return 2.0 * std::sqrt(stiffness / m) * std::sin(0.5 * phase(n)); }

  TestSim in_mode(int n, const Vec3& displacement) const {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    PointId last = sim.nail(Vec3(0.0));
    for (int j = 1; j <= masses; ++j) {
      const PointId point = sim.add(Vec3(j * a, 0.0, 0.0) + shape(n, j) * displacement, m);
      sim.join(last, point, k, l0, d);
      last = point;
    }
    if (!free_end) sim.join(last, sim.nail({(masses + 1) * a, 0.0, 0.0}), k, l0, d);
    return sim;
  }

  // RMS distance of the points from mode n with `factor` times its amplitude, relative to that amplitude
  double distance_from_mode(const TestSim& sim, int n, const Vec3& displacement, double factor) const {
    double worst = 0.0;
    for (int j = 1; j <= masses; ++j)
      worst = std::max(worst, glm::distance(sim.state.position[j], Vec3(j * a, 0.0, 0.0) + factor * shape(n, j) * displacement));
    return worst / glm::length(displacement);
  }
};

// Verlet on a mode released from rest: x_s = A cos(s theta) with cos(theta) = 1 - (h w)^2 / 2, exactly
TEST(Chain, VibratesLongitudinallyInItsModesAtAnyAmplitude) {
  const Vec3 displacement(0.02, 0.0, 0.0);
  for (const bool free_end : {false, true})
    for (const int masses : {1, 2, 7}) {
      const Chain chain{masses, free_end};
      for (int n = 1; n <= masses; ++n) {
        const double w = chain.frequency(n, chain.k), seconds = 3.3 / w;
        const int steps = 200;
        TestSim sim = chain.in_mode(n, displacement);
        sim.run(verlet(), seconds, steps);
        const double theta = std::acos(1.0 - 0.5 * std::pow(seconds / steps * w, 2));
        EXPECT_LT(chain.distance_from_mode(sim, n, displacement, std::cos(steps * theta)), 1e-11)
            << masses << " masses, mode " << n << (free_end ? ", one end free" : "");
      }
    }
}

// x = A cos(w t), with a fourth-order method at h w = 1/100: error w t (h w)^4 / 120
TEST(Chain, VibratesLongitudinallyAtItsNaturalFrequencies) {
  const Vec3 displacement(0.02, 0.0, 0.0);
  const Chain chain{5, false};
  for (int n = 1; n <= 5; ++n) {
    const double w = chain.frequency(n, chain.k);
    TestSim sim = chain.in_mode(n, displacement);
    sim.run(runge_kutta(), 3.3 / w, 330);
    EXPECT_LT(chain.distance_from_mode(sim, n, displacement, std::cos(3.3)), 1e-9) << "mode " << n;
  }
}

// pretension T = k (a - l0) gives w = 2 sqrt(T / (m a)) sin(..), an effective stiffness T / a; for l0 = 0 this is k, at any amplitude
TEST(Chain, VibratesTransverselyWithAStiffnessSetByItsTension) {
  for (int n = 1; n <= 5; ++n) {
    Chain chain{5, false};
    chain.l0 = 0.06;
    const double w = chain.frequency(n, chain.k * (chain.a - chain.l0) / chain.a);
    const Vec3 small(0.0, 3e-7, 4e-7);
    TestSim sim = chain.in_mode(n, small);
    sim.run(runge_kutta(), 3.3 / w, 330);
    // the masses are displaced along x by A^2 / a
    EXPECT_LT(chain.distance_from_mode(sim, n, small, std::cos(3.3)), glm::length(small) / chain.a) << "mode " << n;

    chain.l0 = 0.0;
    const Vec3 large(0.1, 0.3, 0.4);
    sim = chain.in_mode(n, large);
    sim.run(runge_kutta(), 3.3 / chain.frequency(n, chain.k), 330);
    EXPECT_LT(chain.distance_from_mode(sim, n, large, std::cos(3.3)), 1e-9) << "mode " << n << ", no rest length";
  }
}

// a dashpot on every spring damps mode n by zeta = d w_n / (2 k)
TEST(Chain, WithDashpotsDampsEachModeInProportionToItsFrequency) {
  const Vec3 displacement(0.02, 0.0, 0.0);
  Chain chain{5, false};
  chain.d = 1.5;
  for (int n = 1; n <= 5; ++n) {
    const double w = chain.frequency(n, chain.k);
    const DampedSpring exact{w, chain.d * w / (2.0 * chain.k), 1.0, 0.0};
    TestSim sim = chain.in_mode(n, displacement);
    sim.run(runge_kutta(), 3.3 / w, 330);
    EXPECT_LT(chain.distance_from_mode(sim, n, displacement, exact.position(3.3 / w)), 1e-9) << "mode " << n;
  }
}

class Rotation : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Rotation, testing::ValuesIn(every_method()), method_name);

// two masses connected by a spring: k (2r - l0) = m r W^2, so 2r = l0 / (1 - m W^2 / (2k))
TEST_P(Rotation, OfTwoMassesIsUniform) {
  const double m = 0.3, k = 40.0, l0 = 0.5, w = 6.0, r = 0.5 * l0 / (1.0 - m * w * w / (2.0 * k)), seconds = 1.1;
  const auto error = [&](int steps) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId first = sim.add({r, 0.0, 0.0}, m, {0.0, w * r, 0.0}), second = sim.add({-r, 0.0, 0.0}, m, {0.0, -w * r, 0.0});
    sim.join(first, second, k, l0);
    sim.run(method(), seconds, steps);
    const Vec3 exact = r * Vec3(std::cos(w * seconds), std::sin(w * seconds), 0.0);
    return glm::distance(sim.position(first), exact) + glm::distance(sim.position(second), -exact);
  };
  expect_order(error, asymptotic_steps(method().order), method().order);
}

// r = l0 / (1 - m W^2 / k)
TEST_P(Rotation, AboutANailIsUniform) {
  const double m = 0.3, k = 40.0, l0 = 0.5, w = 6.0, r = l0 / (1.0 - m * w * w / k), seconds = 1.1;
  const auto error = [&](int steps) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId point = sim.add({0.0, 0.0, r}, m, {w * r, 0.0, 0.0});
    sim.join(sim.nail(Vec3(0.0)), point, k, l0);
    sim.run(method(), seconds, steps);
    return glm::distance(sim.position(point), r * Vec3(std::sin(w * seconds), 0.0, std::cos(w * seconds)));
  };
  expect_order(error, asymptotic_steps(method().order), method().order);
}

// a spring without rest length is an oscillator in every direction, so the path is an ellipse about the nail
TEST(SpringWithoutRestLength, MovesItsPointAlongAnEllipse) {
  const double m = 0.5, k = 50.0, w = 10.0;
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const Vec3 x0(0.3, -0.1, 0.2), v0(1.0, 2.0, -0.5);
  const PointId point = sim.add(x0, m, v0);
  sim.join(point, sim.nail(Vec3(0.0)), k, 0.0);
  sim.run(runge_kutta(), 1.0, 2000);
  EXPECT_LT(glm::distance(sim.position(point), std::cos(w) * x0 + std::sin(w) / w * v0), 1e-10);
}

TEST(SpringWithoutRestLength, AllowsItsPointToPassThroughTheNail) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId point = sim.add({0.0, 0.0, 0.0}, 1.0, {1.0, 0.0, 0.0});
  sim.join(sim.nail(Vec3(0.0)), point, 100.0, 0.0);
  sim.run(runge_kutta(), 1.0, 2000);
  EXPECT_NEAR(sim.position(point).x, std::sin(10.0) / 10.0, 1e-10);
}

}  // namespace
}  // namespace hooke
