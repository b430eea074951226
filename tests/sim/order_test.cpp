// Declared properties of the methods, measured: orders, stability limits, symplecticity.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "sim/forces/terms/rows.h"
#include "sim/methods/rows.h"
#include "support/convergence.h"
#include "support/nets.h"

namespace hooke {
namespace {

class Row : public EveryMethod {
 protected:
  // The number of steps for a quarter of a second of the net. The longest step is a quarter of a radian of the fastest mode for order one,
  // and some radians for order eight: few enough steps for changes far above round-off (1e-14 m), and enough for the next term of the
  // error, smaller by a power of h omega, to change the measured order by less than a tenth. A single sweep over the constraints, far from
  // their solution, needs much shorter steps.
  int steps(int order) const {
    if (method().iterates()) return 400;
    if (method().stability == Stability::EachSpring) return 24000;
    if (method().stability == Stability::AStable || method().stability == Stability::LStable)
      return order == 1 ? 200 : order == 2 ? 40 : 60;
    return order == 1 ? 1000 : order == 2 ? 250 : order == 4 ? 120 : 28;
  }

  // Forces that start suddenly excite faster modes, so first-order implicit methods need smaller steps to reach their asymptotic range.
  int refinement() const { return method().order == 1 && method().is_implicit() ? 2 : 1; }

  State after(const TestSim& start, int count) const {
    TestSim sim = start;
    sim.run(method(), 0.25, count);
    return sim.state;
  }

  // Richardson: the change when the step is halved falls by 2^p. The order of a method is the minimum of its orders in position and
  // velocity; the positions of symplectic Euler are those of Verlet.
  void expect_measured(const TestSim& start, int order, int refinement = 1) const {
    const int count = refinement * steps(order);
    const State coarse = after(start, count), middle = after(start, 2 * count), fine = after(start, 4 * count);
    const auto measured = [&](auto change) { return std::log2(change(coarse, middle) / change(middle, fine)); };
    EXPECT_NEAR(std::min(measured(distance), measured(difference_in_speed)), order, std::max(0.1, 0.02 * order))
        << "changes " << distance(coarse, middle) << " m and " << distance(middle, fine) << " m";
  }

  static double difference_in_speed(const State& first, const State& second) {
    double sum = 0.0;
    for (std::size_t i = 0; i < first.velocity.size(); ++i) {
      const Vec3 difference = first.velocity[i] - second.velocity[i];
      sum += glm::dot(difference, difference);
    }
    return std::sqrt(sum);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Row, testing::ValuesIn(every_method()), method_name);

// net W2 of the accuracy tables: 16 x 16 points, k = 100 N/m, swinging under tension
TEST_P(Row, MeetsItsOrder) { expect_measured(net(16, 1e2, 0.0), method().order); }

TEST_P(Row, MeetsItsOrderWithDashpots) { expect_measured(net(16, 1e2, 0.03), method().order_with.damped); }

TEST_P(Row, MeetsItsOrderWithDrag) {
  TestSim sim = net(16, 1e2, 0.0);
  sim.system.drag = 3.0;
  expect_measured(sim, method().order_with.drag);
}

TEST_P(Row, MeetsItsOrderWithDashpotsAndDrag) {
  TestSim sim = net(16, 1e2, 0.03);
  sim.system.drag = 3.0;
  expect_measured(sim, std::min(method().order_with.damped, method().order_with.drag));
}

// The net with wind on its points and a pull on its center of mass.
TestSim windy_net() {
  TestSim sim = net(16, 1e2, 0.0);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).radius = 0.03;
  sim.system.forces = {{.term = &wind_force, .values = {1.5, 0.0, 1.0, 2.0, 0.0, 0.0, 1.0, 1.0}}};
  return sim;
}

TEST_P(Row, MeetsItsOrderWithWind) { expect_measured(windy_net(), method().order_with.force_terms, refinement()); }

TEST_P(Row, MeetsItsOrderWithAPullOnTheCenterOfMass) {
  TestSim sim = net(16, 1e2, 0.0);
  // of the points that are not nailed, all of the same mass
  Vec3 center(0.0);
  for (Index i = 16; i < sim.system.point_count(); ++i)
    center += sim.state.position[i] / static_cast<double>(sim.system.point_count() - 16);
  sim.system.forces = {{.term = &mass_center_force, .values = {center.x, center.y, center.z - 0.02, 4.0, 6.0}}};
  expect_measured(sim, method().order_with.force_terms, refinement());
}

TEST_P(Row, MeetsItsOrderWithWindAndDashpots) {
  TestSim sim = windy_net();
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->damping = 0.03;
  sim.system.drag = 1.0;
  expect_measured(sim, std::min({method().order_with.force_terms, method().order_with.damped, method().order_with.drag}), refinement());
}

// Two masses connected by a spring fall onto a floor without restitution, stop falling, and slide on it under friction while the spring
// oscillates.
TestSim sliding_pair() {
  TestSim sim;
  const PointId first = sim.add({0.0, 0.05, 0.0}, 1.0, {2.0, 0.0, 0.3}), second = sim.add({1.0, 0.05, 0.1}, 0.5, {2.0, 0.0, -0.4});
  sim.join(first, second, 20.0, 0.9);
  sim.system.colliders = {{.shape = Plane{}, .restitution = 0.0, .friction = 0.3}};
  return sim;
}

// The same on the top of a sphere, on which they slide down.
TestSim sliding_pair_on_sphere() {
  TestSim sim = sliding_pair();
  sim.system.colliders = {{.shape = Sphere{.center = {0.5, -2.0, 0.0}, .radius = 2.0}, .restitution = 0.0, .friction = 0.3}};
  return sim;
}

// The same floor without friction: only the impact is inelastic.
TestSim falling_pair() {
  TestSim sim = sliding_pair();
  sim.system.colliders[0].friction = 0.0;
  return sim;
}

// On a smaller ball without friction, which both leave, one at either side.
TestSim pair_that_leaves_a_ball() {
  TestSim sim;
  const PointId first = sim.add({0.2, 0.7, 0.0}, 1.0, {0.0, -2.0, 0.0}), second = sim.add({-0.15, 0.6, 0.1}, 0.5, {0.0, -2.0, 0.1});
  sim.join(first, second, 5.0, 0.4);
  sim.system.colliders = {{.shape = Sphere{.radius = 0.48}, .restitution = 0.0}};
  return sim;
}

// The same with friction.
TestSim pair_that_leaves_a_rough_ball() {
  TestSim sim = pair_that_leaves_a_ball();
  sim.system.colliders[0].friction = 0.3;
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->stiffness = 20.0;
  return sim;
}

// A pair on a floor that moves down faster than it falls, from the middle of the run on.
TestSim pair_that_leaves_a_floor() {
  TestSim sim;
  const PointId first = sim.add({0.0, 0.0, 0.0}, 1.0, {0.2, 0.0, 0.0}), second = sim.add({1.0, 0.0, 0.1}, 0.5, {0.2, 0.0, -0.1});
  sim.join(first, second, 20.0, 0.9);
  sim.system.colliders = {{.shape = Plane{}, .restitution = 0.0, .path = {.amplitude = {0.0, 0.1, 0.0}, .frequency = 2.0, .phase = -1.5}}};
  for (Index i = 0; i < 2; ++i) sim.state.position[i].y = sim.system.colliders[0].path.offset(0.0).y;
  return sim;
}

// The same on a nailed ball.
TestSim pair_that_leaves_a_nailed_ball() {
  TestSim sim = pair_that_leaves_a_ball();
  sim.system.colliders.clear();
  sim.nail(Vec3(0.0));
  sim.system.point(0).radius = sim.system.point(1).radius = 0.05;
  sim.system.point(2).radius = 0.43;
  sim.system.contact = {.points = true, .friction = 0.0};
  return sim;
}

// The order through an impact without restitution and the motion on the surface after it. The place of the impact within a step varies with
// the number of steps, and the error with it: a fit over many numbers of steps.
// Infinity where the error is that of rounding with few steps already.
double order_after_impact(const Integrator& method, TestSim (*make)()) {
  static std::map<TestSim (*)(), State> references;
  if (!references.contains(make)) {
    TestSim sim = make();
    sim.run(runge_kutta4, 0.5, 1 << 18);
    references[make] = sim.state;
  }
  const State& reference = references[make];
  const auto error_at = [&](int count) {
    // RMS over neighboring numbers of steps
    double sum = 0.0;
    constexpr int neighbors = 24;
    for (int i = 0; i < neighbors; ++i) {
      TestSim sim = make();
      sim.run(method, 0.5, count + i * count / neighbors);
      sum += std::pow(distance(sim.state, reference), 2);
    }
    return std::sqrt(sum / neighbors);
  };
  constexpr double rounding = 1e-13;  // [m]
  const double coarse = error_at(200), fine = error_at(1600);
  if (coarse < 1e2 * rounding) return std::numeric_limits<double>::infinity();
  return std::log2(coarse / fine) / 3.0;
}

TEST_P(Row, MeetsItsOrderUnderFriction) { EXPECT_NEAR(order_after_impact(method(), sliding_pair), friction_order, 0.2); }

TEST_P(Row, MeetsItsOrderUnderFrictionOnASphere) { EXPECT_NEAR(order_after_impact(method(), sliding_pair_on_sphere), friction_order, 0.2); }

TEST_P(Row, MeetsItsOrderWhereItLeavesABall) {
  // the error of the slide and that of the time of leaving cancel in part
  EXPECT_NEAR(order_after_impact(method(), pair_that_leaves_a_ball), method().order_with.contact, 0.3);
  EXPECT_NEAR(order_after_impact(method(), pair_that_leaves_a_rough_ball), friction_order, 0.2);
}

TEST_P(Row, MeetsItsOrderSlidingOnABall) {
  EXPECT_NEAR(order_after_impact(method(), pair_that_leaves_a_nailed_ball), method().order_with.contact, 0.2);
}

// What happens at a floor is exact: here, methods of fourth order keep it.
void expect_order_at_floor(const Integrator& method, double order) {
  if (method.order <= 2)
    EXPECT_NEAR(order, method.order_with.contact, 0.2);
  else
    EXPECT_GT(order, 3.5);
}

TEST_P(Row, MeetsItsOrderWhereItLeavesAFloor) { expect_order_at_floor(method(), order_after_impact(method(), pair_that_leaves_a_floor)); }

TEST_P(Row, MeetsItsOrderThroughAnInelasticImpact) { expect_order_at_floor(method(), order_after_impact(method(), falling_pair)); }

// The largest modulus of the eigenvalues of one step, which is the growth factor of a mode: of the roots of a cubic by simultaneous
// iteration (K. Weierstrass, E. Durand, I. O. Kerner).
double growth(const Integrator& method, const Oscillator& oscillator) {
  const auto [trace, determinant, third] = method.amplification(oscillator);
  const double discriminant = 0.25 * trace * trace - determinant;
  if (third == 0.0) return discriminant < 0.0 ? std::sqrt(determinant) : 0.5 * std::abs(trace) + std::sqrt(discriminant);
  using Complex = std::complex<double>;
  std::array<Complex, 3> root{Complex(1.0, 0.0), Complex(0.4, 0.9), Complex(-0.65, 0.72)};
  for (int iteration = 0; iteration < 60; ++iteration)
    for (std::size_t i = 0; i < 3; ++i) {
      const Complex z = root[i], value = ((z - trace) * z + determinant) * z - third;
      root[i] = z - value / ((z - root[(i + 1) % 3]) * (z - root[(i + 2) % 3]));
    }
  return std::max({std::abs(root[0]), std::abs(root[1]), std::abs(root[2])});
}

// x'' = -w^2 x - lambda x' - c x', a spring without rest length attached to a nail: growth of (x, v / w) over `count` steps.
double growth_after(const Integrator& method, double omega, double lambda, double drag, double h, int count) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.drag = drag;
  const PointId point = sim.add({1.0, 0.0, 0.0});
  sim.join(point, sim.nail(Vec3(0.0)), omega * omega, 0.0, lambda);
  sim.run(method, h * count, count);
  return std::hypot(sim.position(point).x, sim.velocity(point).x / omega);
}

// just below the limit the motion stays bounded, just above it grows; the limit reported for a whole scene does not exceed it
TEST_P(Row, IsStableUpToItsLimitAndNotBeyond) {
  if (method().stability != Stability::Conditional && method().stability != Stability::None) return;
  const double omega = 20.0;
  for (const double lambda : {0.0, 5.0, 30.0, 300.0})
    for (const double drag : {0.0, 4.0}) {
      SCOPED_TRACE(testing::Message() << "lambda = " << lambda << ", c = " << drag);
      const auto growth_at = [&](double h) { return growth(method(), {h * h * omega * omega, h * lambda, h * drag}); };
      double limit = 1e-5;
      while (growth_at(limit) <= 1.0 + 1e-12 && limit < 10.0) limit *= 1.0001;

      const Spectrum spectrum{.omega = omega, .dashpot_rate = lambda, .drag_rate = drag, .min_dashpot_ratio = lambda / (omega * omega)};
      const double stated = largest_stable_step(method(), spectrum);
      EXPECT_LE(stated, limit * 1.001);
      if (limit > 1e-5) {
        EXPECT_LT(growth_after(method(), omega, lambda, drag, 0.995 * limit, 5000), 50.0);
        if (lambda == 0.0) {
          EXPECT_NEAR(stated, limit, 1e-3 * limit);
        }
      }

      // some methods are stable again slightly above the limit: use the fastest growth nearby
      double beyond = std::max(limit, 1e-3);
      for (double h = beyond; h < 1.02 * std::max(limit, 1e-3); h *= 1.0001)
        if (growth_at(h) > growth_at(beyond)) beyond = h;
      const int count = std::min(20000, static_cast<int>(std::log(1e6) / std::log(growth_at(beyond))) + 1);
      // the start contains less of a mode of which the acceleration of the step before is a part
      const double part = method().amplification({.h_lambda = 1.0}).third == 0.0 ? 0.01 : 1e-4;
      EXPECT_GT(growth_after(method(), omega, lambda, drag, beyond, count), part * std::pow(growth_at(beyond), count)) << count << " steps";
    }
}

// x = x0 cos(theta t / h) |R|^(t / h), the textbook solution, theta = h w, from the eigenvalues |R| e^(+- i theta') of a step; R(z) of
// Runge-Kutta methods at z = i theta
TEST(Amplification, OfAnUndampedModeMatchesTheTextbook) {
  const auto expect_eigenvalue = [](std::string_view id, double theta, std::complex<double> expected) {
    const auto [trace, determinant, third] = find_integrator(id)->amplification({.h_omega_squared = theta * theta});
    EXPECT_NEAR(trace, 2.0 * expected.real(), 1e-12 * std::max(1.0, std::abs(trace))) << id << ", h w = " << theta;
    EXPECT_NEAR(determinant, std::norm(expected), 1e-12 * std::max(1.0, determinant)) << id << ", h w = " << theta;
    EXPECT_EQ(third, 0.0) << id;
  };
  for (const double theta : {0.01, 0.3, 1.0, 1.9}) {
    const std::complex<double> z(0.0, theta), turned = std::polar(1.0, std::acos(1.0 - 0.5 * theta * theta));
    expect_eigenvalue("explicit_euler", theta, std::polar(std::sqrt(1.0 + theta * theta), std::atan(theta)));
    expect_eigenvalue("symplectic_euler", theta, turned);
    expect_eigenvalue("velocity_verlet", theta, turned);
    expect_eigenvalue("velocity_verlet_explicit", theta, turned);
    expect_eigenvalue("runge_kutta4", theta, 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
    for (const char* id : {"implicit_euler", "baraff_witkin", "xpbd", "projective_dynamics", "vertex_block_descent"})
      expect_eigenvalue(id, theta, std::polar(1.0 / std::sqrt(1.0 + theta * theta), std::atan(theta)));
    expect_eigenvalue("implicit_midpoint", theta, std::polar(1.0, 2.0 * std::atan(0.5 * theta)));
    // R. E. Bank et al., Transient simulation of silicon devices and circuits, 1985: the trapezoidal rule to g h, then BDF2
    const double g = 2.0 - std::numbers::sqrt2;
    expect_eigenvalue(
        "tr_bdf2", theta,
        ((1.0 + (1.0 - g) * (1.0 - g)) * z + 2.0 * (2.0 - g)) / (z * z * (1.0 - g) * g + z * (g * g - 2.0) + 2.0 * (2.0 - g)));
  }
  // of orders four and eight: the difference from the exponential is z^(p + 1) times a constant; further terms are smaller by powers of
  // theta
  for (const auto& [id, order] : {std::pair("blanes_moan4", 4), {"esdirk4", 4}, {"dop853", 8}}) {
    const Integrator& method = *find_integrator(id);
    const auto off = [&method](double theta) {
      const auto [trace, determinant, third] = method.amplification({.h_omega_squared = theta * theta});
      return std::abs(std::complex<double>(0.5 * trace, std::sqrt(determinant - 0.25 * trace * trace)) - std::polar(1.0, theta));
    };
    const double theta = order == 4 ? 0.05 : 0.4;
    EXPECT_NEAR(std::log2(off(theta) / off(0.5 * theta)), order + 1, 0.1) << id;
  }
}

// the determinant of an undamped step is 1 if and only if the method is symplectic
TEST_P(Row, IsAreaPreservingOnlyIfSymplectic) {
  const double determinant = method().amplification({.h_omega_squared = 1.44}).determinant;
  if (method().is_symplectic()) {
    EXPECT_NEAR(determinant, 1.0, 1e-14);
  } else {
    EXPECT_GT(std::abs(determinant - 1.0), 1e-7);
  }
}

}  // namespace
}  // namespace hooke
