// Step limits due to contact. Contact acts at the end of a step, on each point separately.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "support/convergence.h"
#include "support/folds.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr double radius = 0.35;  // [m], of the ball

// A sheet of 16 x 16 points, 1 m, 0.2 kg, falling onto a ball.
TestSim falling_sheet(double k) {
  constexpr int n = 16;
  constexpr double a = 1.0 / (n - 1);
  TestSim sim;
  std::vector<PointId> points;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) points.push_back(sim.add({column * a - 0.48, radius + 0.1, row * a - 0.47}, 0.2 / (n * n)));
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const PointId here = points[row * n + column];
      if (column + 1 < n) sim.join(here, points[row * n + column + 1], k, a);
      if (row + 1 < n) sim.join(here, points[(row + 1) * n + column], k, a);
    }
  sim.system.colliders.push_back({.shape = Sphere{Vec3(0.0), radius}, .restitution = 0.1, .friction = 0.4});
  return sim;
}

// The largest rise of the energy above an earlier value within one second, relative to the weight times the size of the scene [1], seen
// after every so many steps.
double energy_rise(TestSim sim, const Integrator& method, double step, int steps = 1) {
  double lowest = compute_energy(sim.system, sim.state).total(), rise = 0.0;
  const double floor = reference_energy(sim.system, sim.state);
  for (double time = 0.0; time < 1.0 && rise < 1e3; time += steps * step) {
    sim.run(method, steps * step, steps);
    const double energy = compute_energy(sim.system, sim.state).total();
    rise = std::isfinite(energy) ? std::max(rise, (energy - lowest) / floor) : 1e9;
    lowest = std::min(lowest, energy);
  }
  return rise;
}

const Integrator& method(const char* id) { return *find_integrator(id); }

TEST(ContactStep, IsLimitedEvenForUnconditionallyStableMethods) {
  const Spectrum with_contact = bound_spectrum(falling_sheet(60.0).system);
  Spectrum without_contact = with_contact;
  without_contact.contact = false;
  for (const char* id : {"dop853", "xpbd", "implicit_euler", "baraff_witkin", "implicit_midpoint", "tr_bdf2", "esdirk4"}) {
    EXPECT_TRUE(std::isinf(largest_stable_step(method(id), without_contact))) << id;
    EXPECT_EQ(largest_stable_step(method(id), with_contact), 3.0 / with_contact.omega) << id;
  }

  // colliders that are only drawn, or scenes without oscillation
  TestSim sim = falling_sheet(60.0);
  sim.system.colliders[0].solid = false;
  EXPECT_TRUE(std::isinf(largest_stable_step(method("tr_bdf2"), bound_spectrum(sim.system))));
  EXPECT_TRUE(std::isinf(largest_stable_step(method("tr_bdf2"), bound_spectrum(falling_sheet(0.0).system))));
}

TEST(ContactStep, EnergyDoesNotGrowWithinTheLimitAndGrowsFarBeyondIt) {
  const TestSim sim = falling_sheet(60.0);
  for (const char* id : {"dop853", "xpbd", "implicit_euler", "baraff_witkin", "tr_bdf2", "esdirk4"}) {
    const double limit = largest_stable_step(method(id), bound_spectrum(sim.system));
    EXPECT_LT(energy_rise(sim, method(id), limit), 0.01) << id;
  }
  const double limit = largest_stable_step(method("tr_bdf2"), bound_spectrum(sim.system));
  EXPECT_GT(energy_rise(sim, method("tr_bdf2"), 8.0 * limit), 1.0);
}

// A net of 6 x 6 points, tilted at random, that falls on a plane or on a ball and slides there.
TestSim sliding_net(std::uint64_t seed) {
  Random random(seed);
  TestSim sim;
  constexpr int n = 6;
  constexpr double a = 0.1;
  const double stiffness = std::pow(10.0, random.uniform(2.0, 4.0)), friction = std::pow(10.0, random.uniform(-1.0, 0.3));
  const Vec3 along = glm::normalize(Vec3(1.0, random.uniform(-0.4, 0.4), 0.0)),
             across = glm::normalize(Vec3(0.0, random.uniform(-0.4, 0.4), 1.0));
  const Vec3 velocity(random.uniform(-1.0, 1.0), random.uniform(-1.0, 0.0), random.uniform(-1.0, 1.0));
  std::vector<PointId> points;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      points.push_back(
          sim.add(a * ((column - 2.5) * along + (row - 2.5) * across) + Vec3(0.0, 0.3, 0.0), random.uniform(0.01, 0.03), velocity));
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const PointId here = points[row * n + column];
      if (column + 1 < n) sim.join(here, points[row * n + column + 1], stiffness, a);
      if (row + 1 < n) sim.join(here, points[(row + 1) * n + column], stiffness, a);
      if (column + 1 < n && row + 1 < n)
        sim.join(here, points[(row + 1) * n + column + 1], 0.5 * stiffness, a * glm::length(along + across));
    }
  if (random.one_in(2))
    sim.system.colliders = {{.shape = Plane{}, .friction = friction}};
  else
    sim.system.colliders = {{.shape = Sphere{{0.0, -0.8, 0.0}, 0.8}, .friction = friction}};
  return sim;
}

class SlidingNets : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, SlidingNets, testing::ValuesIn(every_method()), method_name);

// With symplectic Euler's velocity but not its path, x' = x + h (v + v') / 2, vibrations along the surface would grow without bound.
TEST_P(SlidingNets, GainNoEnergyUnderFriction) {
  if (method().energy == EnergyTrend::Grows) return;  // without contact, too
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    TestSim sim = sliding_net(seed);
    const double limit = largest_stable_step(method(), bound_spectrum(sim.system)), h = std::min(0.5 * limit, 1.0 / 240.0);
    const double start = compute_energy(sim.system, sim.state).total(), scale = reference_energy(sim.system, sim.state);
    double highest = start;
    for (double time = 0.0; time < 0.8; time += 4.0 * h) {
      sim.run(method(), 4.0 * h, 4);
      const double energy = compute_energy(sim.system, sim.state).total();
      highest = std::isfinite(energy) ? std::max(highest, energy) : 1e9;
    }
    EXPECT_LT(highest - start, 0.02 * scale) << seed << ", from " << start;
  }
}

// Bars whose ends are balls, on a heap in a bin.
TestSim heap_of_bars() {
  TestSim sim;
  sim.system.contact = {.points = true, .restitution = 0.3, .friction = 0.3};
  sim.system.colliders = {{.shape = Plane{}, .restitution = 0.3, .friction = 0.3},
                          {.shape = Plane{{-0.25, 0.0, 0.0}, {1.0, 0.0, 0.0}}},
                          {.shape = Plane{{0.25, 0.0, 0.0}, {-1.0, 0.0, 0.0}}},
                          {.shape = Plane{{0.0, 0.0, -0.25}, {0.0, 0.0, 1.0}}},
                          {.shape = Plane{{0.0, 0.0, 0.25}, {0.0, 0.0, -1.0}}}};
  PointId last{};
  for (int i = 0; i < 40; ++i) {
    const int layer = i / 8, row = i / 4 % 2;
    const PointId id = sim.add({0.11 * (i % 4) - 0.17 + 0.01 * (i % 3), 0.05 + 0.1 * layer, 0.13 * row - 0.1 + 0.013 * (i % 5)}, 0.1);
    sim.system.point(i).radius = 0.04;
    if (i % 2 == 1) sim.join(last, id, 2000.0, 0.11);
    last = id;
  }
  return sim;
}

// Four ropes on each other, crosswise.
TestSim heap_of_ropes() {
  TestSim sim;
  for (int rope = 0; rope < 4; ++rope) {
    PointId last{};
    for (int i = 0; i < 10; ++i) {
      const double along = 0.1 * (i - 4.5), up = 0.05 + 0.06 * rope;
      const PointId id = sim.add(rope % 2 == 1 ? Vec3(0.013, up, along) : Vec3(along, up, 0.017), 0.03);
      if (i > 0) sim.join(last, id, 300.0, 0.1);
      last = id;
    }
  }
  sim.system.colliders = {{.shape = Plane{}, .friction = 0.3}};
  sim.system.contact = {.springs = true, .thickness = 0.02, .friction = 0.3};
  return sim;
}

TestSim folding_sheet() {
  TestSim sim = dropped_sheet(9);
  folds::touch(sim);
  return sim;
}

class ContactStepOf : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, ContactStepOf, testing::ValuesIn(methods_that([](const Integrator& method) {
                           return can_be_stable(method) && &method != find_integrator("symplectic_euler");
                         })),
                         method_name);

// Points that touch each other limit the step of every method; faces and springs, whose contact is a constraint on velocities without a
// stiffness of its own, limit no method further: up to nine tenths of the limit, from which on runge_kutta4 gains energy on the ropes. The
// energy of symplectic Euler is that of the scene only on average.
TEST_P(ContactStepOf, OfThingsThatTouchKeepsTheEnergyWithinTheLimit) {
  for (const auto make : {heap_of_bars, heap_of_ropes, folding_sheet}) {
    const TestSim sim = make();
    const double limit = largest_stable_step(method(), bound_spectrum(sim.system));
    for (const double part : {0.9, 0.6}) EXPECT_LT(energy_rise(sim, method(), part * limit, 5), 0.05) << part;
  }
}

TEST(ContactStep, OfPointsThatTouchIsShorterAndBeyondItEnergyGrows) {
  const TestSim sim = heap_of_bars();
  const Spectrum spectrum = bound_spectrum(sim.system);
  for (const Integrator& row : integrators())
    if (row.stability != Stability::None) {
      EXPECT_NEAR(largest_stable_step(row, spectrum) * spectrum.omega, 1.8, 1e-9) << row.id;
    }
  EXPECT_GT(energy_rise(sim, method("esdirk4"), 2.9 / spectrum.omega, 5), 1.0);
}

}  // namespace
}  // namespace hooke
