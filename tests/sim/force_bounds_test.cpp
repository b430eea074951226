// The bounds on frequencies and damping rates that largest_stable_step uses, against finite-difference derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/force_terms.h"
#include "sim/forces/forces.h"
#include "sim/forces/terms/rows.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/nets.h"
#include "support/random_force_scene.h"

namespace hooke {
namespace {

// The largest |u.A u| / u.u found by power iteration for the symmetric part of A = -M^-1/2 (df/dy) M^-1/2, y = x or v.
double largest_eigenvalue(const Plan& plan, const Motion& motion, bool of_velocity, Random& random) {
  const std::size_t size = motion.x.size();
  const auto is_free = [&](std::size_t at) { return plan.inverse_mass[at % plan.points] != 0.0; };
  const auto sqrt_mass = [&](std::size_t at) { return std::sqrt(plan.mass[at % plan.points]); };
  std::vector<double> u(size);
  for (std::size_t at = 0; at < size; ++at) u[at] = is_free(at) ? random.uniform(-1.0, 1.0) : 0.0;
  const auto norm = [&] {
    double sum = 0.0;
    for (const double each : u) sum += each * each;
    return std::sqrt(sum);
  };

  double quotient = 0.0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double length = norm();
    if (length == 0.0) return 0.0;
    for (double& each : u) each /= length;
    constexpr double step = 1e-6;
    Field plus, minus;
    for (Field* f : {&plus, &minus}) {
      Field x = motion.x, v = motion.v;
      Field& changed = of_velocity ? v : x;
      for (std::size_t at = 0; at < size; ++at)
        if (is_free(at)) changed[at] += (f == &plus ? step : -step) * u[at] / sqrt_mass(at);
      f->assign(size, 0.0);
      compute_position_forces(plan, motion.time, x, v, *f);
    }
    double product = 0.0;
    std::vector<double> next(size, 0.0);
    for (std::size_t at = 0; at < size; ++at) {
      if (!is_free(at)) continue;
      next[at] = -(plus[at] - minus[at]) / (2.0 * step * sqrt_mass(at));
      product += u[at] * next[at];
    }
    quotient = std::max(quotient, product);
    u = next;
  }
  return quotient;
}

TEST(ForceBounds, AreNeverBelowTheTrueValues) {
  constexpr double round_off = 1e-4;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    TestSim sim = random_force_scene(seed, ForceSceneKind::Bounded);
    const Plan plan = make_plan(sim.system);
    Motion motion;
    pack(plan, sim.state, motion);
    const double stiffness = largest_eigenvalue(plan, motion, false, random), rate = largest_eigenvalue(plan, motion, true, random);
    EXPECT_LE(stiffness, plan.spectrum.omega * plan.spectrum.omega * (1.0 + round_off) + round_off) << "scene " << seed;
    EXPECT_LE(rate, plan.spectrum.force_rate * (1.0 + round_off) + round_off) << "scene " << seed;
    EXPECT_TRUE(plan.spectrum.is_bounded) << "scene " << seed;
  }
}

// within the core of the force law, where its slope is largest
TEST(ForceBounds, OfForceLawsAreTight) {
  for (const double power : {0.0, 1.0, 2.0, 4.0}) {
    TestSim sim;
    sim.add({0.5 + 1e-9, 0.0, 0.0});
    sim.system.forces = {{.term = &center_force, .values = {0.5, 0.0, 0.0, 3.0, power, 0.2}}};
    const Plan plan = make_plan(sim.system);
    Motion motion;
    pack(plan, sim.state, motion);
    Random random(1);
    const double at_center = 0.5 * (power + 3.0) * 3.0 * std::pow(0.2, -power - 1.0);
    EXPECT_NEAR(largest_eigenvalue(plan, motion, false, random), at_center, 1e-3 * at_center);
    EXPECT_NEAR(plan.spectrum.omega * plan.spectrum.omega, std::max({at_center, power * at_center / (0.5 * (power + 3.0))}),
                1e-9 * plan.spectrum.omega * plan.spectrum.omega);
  }
}

TEST(ForceBounds, AForceWithoutABoundIsReportedAsUnbounded) {
  TestSim sim;
  sim.add(Vec3(1.0));
  sim.system.forces = {{.term = &wind_force, .values = default_values(wind_force)}};
  EXPECT_FALSE(bound_spectrum(sim.system).is_bounded);
  sim.system.forces = {{.term = &center_force, .values = {0.0, 0.0, 0.0, 1.0, -2.0, 0.1}}};
  EXPECT_FALSE(bound_spectrum(sim.system).is_bounded);
  sim.system.forces[0].on = false;
  EXPECT_TRUE(bound_spectrum(sim.system).is_bounded);
}

// One point, damped at 1035 /s by a force on the center of mass, at steps of 1/300 s.
TestSim overdamped_point() {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.drag = 0.001;
  sim.add({0.1, 0.0, 0.0}, 0.5, {1.0, 0.0, 0.0});
  sim.system.forces = {{.term = &mass_center_force, .values = {0.0, 0.0, 0.0, 100.0, 517.5}}};
  return sim;
}

class Overdamped : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Overdamped, testing::ValuesIn(every_method()), method_name);

TEST_P(Overdamped, APointIsEitherStableOrReportedWithAWarning) {
  TestSim sim = overdamped_point();
  initialize_supply(sim.system, sim.state);
  bool is_reported = false;
  for (int frame = 0; frame < 120 && !is_reported; ++frame) {
    sim.run(method(), 1.0 / 60.0, 5, 1e-8);
    is_reported = find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state)).has_value();
  }
  const bool must_be_stable = method().is_implicit() || method().stability == Stability::Adaptive;
  const bool is_stable = 1.0 / 300.0 <= largest_stable_step(method(), bound_spectrum(sim.system));
  if (must_be_stable) {
    EXPECT_TRUE(is_stable);
  }
  EXPECT_EQ(is_reported, !is_stable);
  if (is_stable) {
    EXPECT_LT(glm::length(sim.state.position[0]), 0.2);
  }
}

TEST_P(Overdamped, ANetIsStableUnderImplicitMethods) {
  if (!method().is_implicit()) return;
  for (const double scale : {1.0, 1e4}) {
    // only these methods damp modes that are far too fast for the step
    if (scale > 1.0 && method().stability != Stability::LStable) continue;
    TestSim sim = net(8, 1e3, 0.0);
    for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = false;
    sim.system.forces = {{.term = &mass_center_force, .values = {0.5, -0.5, 0.0, 20.0 * scale, 500.0 * scale}}};
    initialize_supply(sim.system, sim.state);
    for (int frame = 0; frame < 60; ++frame) {
      sim.run(method(), 1.0 / 60.0, 1);
      ASSERT_FALSE(find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state))) << frame << ", " << scale;
    }
  }
}

// a step of implicit Euler on the center of mass has the closed form (1 + h q / M + h^2 p / M) V = v - h p X / M
TEST(ImplicitForces, ActOnTheCenterOfMassExactly) {
  TestSim sim = net(6, 1e2, 0.0);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = false;
  sim.system.gravity = Vec3(0.0);
  for (Vec3& v : sim.state.velocity) v = {0.3, 0.0, 0.0};
  const double p = 300.0, q = 80.0, h = 0.02;
  sim.system.forces = {{.term = &mass_center_force, .values = {0.0, 0.0, 0.0, p, q}}};
  for (const char* id : {"implicit_euler", "baraff_witkin"}) {
    TestSim stepped = sim;
    double place = 0.0, speed = 0.0;
    for (const Vec3& x : stepped.state.position) place += x.x / 36.0;
    stepped.run(*find_integrator(id), h, 1);
    for (const Vec3& v : stepped.state.velocity) speed += v.x / 36.0;
    EXPECT_NEAR(speed, (0.3 - h * p * place) / (1.0 + h * q + h * h * p), 1e-10) << id;
  }
}

// A scene in which no mechanism can move a point that far.
TEST(Reach, StopsPointsThatAreImplausiblyFarAway) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.add({0.1, 0.0, 0.0}, 1.0, {1.0, 0.0, 0.0});
  initialize_supply(sim.system, sim.state);
  sim.state.time = 2.0;
  sim.state.position[0].x = 50.0;
  EXPECT_FALSE(find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state)));
  sim.state.position[0].x = -1e9;
  const auto found = find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Divergence::Kind::Implausible);
  EXPECT_EQ(found->distance, 1e9);
}

TEST(Reach, AcceptsAPointDrivenAwayByAGrowingForce) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.add({0.1, 0.0, 0.0}, 1.0);
  sim.system.forces = {{.term = &center_force, .values = {0.0, 0.0, 0.0, -400.0, -1.0, 0.1}}};
  initialize_supply(sim.system, sim.state);
  for (int frame = 0; frame < 120; ++frame) {
    sim.run(*find_integrator("dop853"), 1.0 / 60.0, 1, 1e-8);
    ASSERT_FALSE(find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state))) << frame;
  }
  EXPECT_NEAR(std::log(sim.state.position[0].x / 0.05), 40.0, 1e-6);
}

}  // namespace
}  // namespace hooke
