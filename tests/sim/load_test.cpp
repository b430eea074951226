// Loads of points and points on rollers: closed forms, orders and energies of every method. Symbols: F load, m mass, k stiffness.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/forces/energy/energy.h"
#include "sim/methods/implicit/stiffness.h"
#include "sim/methods/rows.h"
#include "sim/model/energy_ledger.h"
#include "sim/statics/equilibrium.h"
#include "sim/statics/modes.h"
#include "sim/step/supply.h"
#include "support/convergence.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

using std::numbers::pi;

constexpr double k = 40.0, m = 0.5, l0 = 0.3;
constexpr Vec3 F{3.0, -4.0, 1.0};

Point& point(TestSim& sim, PointId id) { return sim.system.point(sim.system.index_of(id)); }

// A mass on a spring of a nail, without gravity, pulled along `along` by F to `extension`.
TestSim loaded_spring(double extension) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const Vec3 along = F / glm::length(F);
  const PointId nail = sim.nail({0.1, 0.2, 0.0}), mass = sim.add(Vec3(0.1, 0.2, 0.0) + (l0 + extension) * along, m);
  point(sim, mass).load = F;
  sim.join(nail, mass, k, l0);
  return sim;
}

double extension_of(const TestSim& sim) { return glm::distance(sim.state.position[0], sim.state.position[1]) - l0; }

class Loads : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Loads, testing::ValuesIn(every_method()), method_name);

TEST_P(Loads, StretchASpringByTheirForceOverTheStiffness) {
  TestSim sim = loaded_spring(glm::length(F) / k);
  sim.run(method(), 1.0, 200);
  EXPECT_NEAR(extension_of(sim), glm::length(F) / k, 1e-12);
}

// e = F / k (1 - cos(omega t))
TEST_P(Loads, ExciteAnOscillationAboutTheNewEquilibrium) {
  const double omega = std::sqrt(k / m), seconds = 0.3;
  expect_order(
      [&](int steps) {
        TestSim sim = loaded_spring(0.0);
        sim.run(method(), seconds, steps);
        return std::abs(extension_of(sim) - glm::length(F) / k * (1.0 - std::cos(omega * seconds)));
      },
      method().iterates() ? 200 : asymptotic_steps(method().order) / (method().order == 1 ? 20 : 10) + 4, method().order, 0.3);
}

// A free point falls in the direction of gravity and load: v = (g + F / m) t, of every method
TEST_P(Loads, AccelerateAFreePoint) {
  TestSim sim;
  const PointId free = sim.add(Vec3(0.0), m);
  point(sim, free).load = F;
  sim.run(method(), 0.5, 20);
  EXPECT_LT(glm::distance(sim.velocity(free), 0.5 * (sim.system.gravity + F / m)), 1e-13);
}

// What the load supplies is F.x, however the method moves the point.
TEST_P(Loads, SupplyTheWorkOfTheirPotential) {
  TestSim sim = loaded_spring(0.02);
  sim.state.velocity[1] = {0.3, 0.4, -0.2};
  initialize_supply(sim.system, sim.state);
  const double before = sim.state.supply.net_input;
  const Vec3 from = sim.state.position[1];
  sim.run(method(), 0.2, 50);
  sim.run(method(), 0.2, 50);
  EXPECT_NEAR(sim.state.supply.net_input - before, glm::dot(F, sim.state.position[1] - from), 1e-12);
}

// Exact but for the error of the method, which oscillates.
TEST(Loads, CloseTheBalanceOfEnergy) {
  TestSim sim = loaded_spring(0.02);
  sim.state.velocity[1] = {0.3, 0.4, -0.2};
  const auto energy = [&] { return compute_energy(sim.system, sim.state).total() - glm::dot(F, sim.state.position[1]); };
  const double before = energy();
  sim.run(dop853, 1.0, 400);
  EXPECT_NEAR(energy(), before, 1e-12);
}

// ---- rollers

// A triangle of rods on a nail and a roller that is free along x, under a load on its top.
struct Truss {
  static constexpr double stiffness = 2e3, load = 60.0;
  static TestSim make() {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId nail = sim.nail(Vec3(0.0)), roller = sim.add({2.0, 0.0, 0.0}), top = sim.add({1.0, 1.0, 0.0});
    point(sim, roller).fixed_axes = 6;
    point(sim, top).load = {0.0, -load, 0.0};
    point(sim, top).fixed_axes = 4;
    for (const auto& [a, b] : {std::pair{nail, roller}, {nail, top}, {roller, top}})
      sim.join(a, b, stiffness, glm::distance(sim.position(a), sim.position(b)));
    return sim;
  }
  // Half the load goes down each rod, P d / (2 h), whose horizontal part P b / (4 h) pulls the chord of length b.
  static void expect_equilibrium(const TestSim& sim, double tolerance) {
    const Vec3 roller = sim.state.position[1], top = sim.state.position[2];
    const double b = roller.x, h = top.y, d = glm::length(top);
    EXPECT_EQ(roller.y, 0.0);
    EXPECT_EQ(roller.z, 0.0);
    EXPECT_NEAR(top.x, 0.5 * b, tolerance);
    EXPECT_NEAR(b, 2.0 + load * b / (4.0 * h) / stiffness, tolerance);
    EXPECT_NEAR(d, std::sqrt(2.0) - load * d / (2.0 * h) / stiffness, tolerance);
  }
};

TEST(Rollers, CarryATruss) {
  TestSim sim = Truss::make();
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  StiffnessMatrix matrix(plan);
  EXPECT_LT(find_equilibrium(plan, matrix, 1e-10, 100, motion.x, std::atomic<bool>(false)), 1e-10);
  unpack(plan, motion, sim.state);
  Truss::expect_equilibrium(sim, 1e-12);
}

class Rollers : public EveryMethod {
 protected:
  // A cart on a rail along x and one on an inclined pair of axes, with masses on damped springs, a load, drag and gravity.
  static TestSim carts(double damping) {
    TestSim sim;
    const PointId cart = sim.add({0.0, 0.1, 0.2}, 1.0, {0.2, 0.0, 0.0}), bead = sim.add({0.9, 0.2, 0.0}, 0.7);
    const PointId first = sim.add({0.5, -0.6, 0.1}, 0.6, {0.3, 0.1, 0.4}), second = sim.add({1.4, -0.4, -0.2}, 0.4, {0.0, -0.5, 0.0});
    const PointId nail = sim.nail({-0.6, 0.3, 0.0});
    point(sim, cart).fixed_axes = 6;
    point(sim, bead).fixed_axes = 1;
    point(sim, bead).load = {2.0, 1.0, -0.5};
    sim.join(nail, cart, 30.0, 0.5, damping);
    sim.join(cart, first, 40.0, 0.8, damping);
    sim.join(bead, first, 60.0, 0.7, damping);
    sim.join(first, second, 50.0, 1.0, damping);
    sim.join(cart, bead, 20.0, 0.9, damping);
    return sim;
  }
  State after(double damping, int steps) const {
    TestSim sim = carts(damping);
    sim.run(method(), 0.4, steps);
    return sim.state;
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Rollers, testing::ValuesIn(every_method()), method_name);

double distance_between(const State& a, const State& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    const Vec3 x = a.position[i] - b.position[i], v = a.velocity[i] - b.velocity[i];
    sum += glm::dot(x, x) + glm::dot(v, v);
  }
  return std::sqrt(sum);
}

TEST_P(Rollers, StayExactlyOnTheirAxes) {
  for (const double damping : {0.0, 2.0}) {
    const State start = carts(damping).state, end = after(damping, 200);
    for (const auto& [i, c] : {std::pair{0, 1}, {0, 2}, {1, 0}}) {
      EXPECT_EQ(end.position[i][c], start.position[i][c]);
      EXPECT_EQ(end.velocity[i][c], 0.0);
    }
    EXPECT_GT(std::abs(end.position[0].x - start.position[0].x), 0.005);
  }
}

// All methods lead to the same motion, each at its order.
TEST_P(Rollers, LeaveEveryMethodItsOrder) {
  for (const double damping : {0.0, 2.0}) {
    TestSim reference = carts(damping);
    reference.run(runge_kutta4, 0.4, 20'000);
    const int order = damping > 0.0 ? std::min(method().order, method().order_with.damped) : method().order;
    const int steps = order == 1 ? 2000 : order == 2 ? 200 : order == 4 ? 60 : 12;
    expect_order([&](int count) { return distance_between(after(damping, count), reference.state); }, steps, order, 0.3);
  }
}

// Bead M on a rail with a mass m below on a stiff rod of length L: omega^2 = (1 + m / M) g / L
TEST(Rollers, LetAPendulumSwingAboutTheCommonCenter) {
  constexpr double M = 0.8, mass = 0.5, L = 1.2, stiffness = 1e7, amplitude = 1e-4;
  TestSim sim;
  const PointId cart = sim.add(Vec3(0.0), M), bob = sim.add({0.0, -L - mass * 9.81 / stiffness, 0.0}, mass);
  point(sim, cart).fixed_axes = 6;
  sim.join(cart, bob, stiffness, L);
  const double omega = std::sqrt((1.0 + mass / M) * 9.81 / (L + mass * 9.81 / stiffness));
  // the center of mass stays at rest along x
  sim.state.position[0].x = amplitude * mass / (M + mass);
  sim.state.position[1].x = -amplitude * M / (M + mass);
  sim.run(velocity_verlet, 0.25 * 2.0 * pi / omega, 20'000);
  EXPECT_NEAR((sim.state.position[0].x - sim.state.position[1].x) / amplitude, 0.0, 1e-4);
  EXPECT_NEAR(M * sim.state.position[0].x + mass * sim.state.position[1].x, 0.0, 1e-12);

  // the same frequency as the slowest mode
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  motion.x = {0.0, 0.0, 0.0, -L - mass * 9.81 / stiffness, 0.0, 0.0};
  StiffnessMatrix matrix(plan);
  const auto mode = slowest_mode(plan, {}, motion.x, 1e-6, matrix);
  ASSERT_TRUE(mode);
  EXPECT_NEAR(mode->omega, std::sqrt(9.81 / L), 1e-3);
}

TEST_P(Rollers, SupplyNoEnergy) {
  TestSim sim = carts(0.0);
  initialize_supply(sim.system, sim.state);
  const double before = sim.state.supply.net_input;
  const Vec3 from = sim.state.position[1];
  sim.run(method(), 0.2, 100);
  EXPECT_NEAR(sim.state.supply.net_input - before, glm::dot(Vec3(2.0, 1.0, -0.5), sim.state.position[1] - from), 1e-12);
}

// A ball that falls on a roller bounces as from a nail.
TEST(Rollers, AreNotPushedByContact) {
  TestSim sim;
  const PointId roller = sim.add(Vec3(0.0), 1.0, {0.5, 0.0, 0.0}), ball = sim.add({0.06, 0.5, 0.0}, 1.0, {0.5, 0.0, 0.0});
  point(sim, roller).fixed_axes = 2;
  point(sim, roller).radius = point(sim, ball).radius = 0.1;
  sim.system.contact = {.points = true, .restitution = 1.0, .friction = 0.0};
  const double energy = compute_energy(sim.system, sim.state).total();
  sim.run(velocity_verlet, 0.4, 400);
  EXPECT_EQ(sim.velocity(roller), Vec3(0.5, 0.0, 0.0));
  EXPECT_GT(sim.velocity(ball).x, 1.0);
  EXPECT_GT(std::abs(compute_energy(sim.system, sim.state).total() - energy), 0.1);
}

// A rope under the strain limit pulls a cart.
TEST(Rollers, AreMovedByTheStrainLimit) {
  TestSim sim;
  const PointId cart = sim.add(Vec3(0.0)), mass = sim.add({0.8, -0.6, 0.0}, 0.5);
  point(sim, cart).fixed_axes = 6;
  sim.join(cart, mass, 5.0, 1.0);
  sim.system.strain_limit = 0.05;
  sim.run(velocity_verlet, 0.3, 300);
  EXPECT_GT(sim.position(cart).x, 0.01);
  EXPECT_EQ(sim.position(cart).y, 0.0);
  EXPECT_LT(glm::distance(sim.position(cart), sim.position(mass)), 1.0502);
}

}  // namespace
}  // namespace hooke
