// Bending with the rest shape as built.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/force_tangent.h"
#include "sim/forces/forces.h"
#include "sim/methods/rows.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/folded_strip.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

Field force_as_built(const TestSim& sim) {
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  Field f(motion.x.size(), 0.0);
  add_force_terms(plan, 0.0, motion.x, motion.v, f);
  return f;
}

double energy_as_built(const TestSim& sim) {
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  return bending_force.potential(plan, plan.forces[0].values, 0.0, motion.x.data());
}

double size_of(const Field& f) {
  double sum = 0.0;
  for (const double each : f) sum += each * each;
  return std::sqrt(sum);
}

// The strip, displaced at random by up to `part` of a cell.
TestSim crumpled_strip(double part, double damping_time = 0.0, std::uint64_t seed = 1) {
  TestSim sim = folded_strip(6, 1.3, 0.02, 50.0, damping_time);
  Random random(seed);
  const auto vector = [&] { return Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)); };
  for (Vec3& x : sim.state.position) x += 0.1 * part * vector();
  for (Vec3& v : sim.state.velocity) v = vector();
  return sim;
}

TEST(RestAngle, IsTheAngleBetweenTheFacesWithItsSign) {
  for (double angle = -3.1; angle <= 3.1; angle += 0.1) {
    const Vec3 q(std::cos(angle), 0.0, -std::sin(angle));
    EXPECT_NEAR(hinge_angle({-1.0, 0.3, 0.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, q + Vec3(0.0, 0.7, 0.0)), angle, 1e-15);
    EXPECT_NEAR(hinge_angle(q, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, {-1.0, 0.3, 0.0}), angle, 1e-15) << "from the other face";
  }
  EXPECT_EQ(hinge_angle({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(hinge_angle({-1e200, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 1e200, 0.0}, {1e200, 0.0, 0.0}), 0.0);
}

TEST(RestAngle, AFoldedStripAsBuiltFeelsNoForce) {
  for (const double angle : {0.2, 1.5, 2.8}) {
    TestSim sim = folded_strip(9, angle, 0.02, 50.0, 0.01);
    EXPECT_EQ(size_of(force_as_built(sim)), 0.0);
    EXPECT_EQ(energy_as_built(sim), 0.0);
    sim.system.forces[0].values[2] = 0.0;
    EXPECT_GT(size_of(force_as_built(sim)), 0.1) << "with a flat rest shape";
  }
}

// Wherever it is, and however it is turned.
TEST(RestAngle, AFoldedStripStaysFoldedWhereverItIs) {
  TestSim sim = folded_strip(9, 1.5, 0.02, 50.0, 0.01);
  const Vec3 axis = glm::normalize(Vec3(0.3, -0.5, 0.8)), side = glm::normalize(glm::cross(axis, Vec3(1.0, 0.0, 0.0)));
  const Vec3 third = glm::cross(axis, side);
  for (Vec3& x : sim.state.position) x = Vec3(1.0, 2.0, -1.0) + x.x * axis + x.y * side + x.z * third;
  sim.system.gravity = Vec3(0.0);
  EXPECT_LT(size_of(force_as_built(sim)), 1e-12);
  const std::vector<Vec3> start = sim.state.position;
  sim.run(velocity_verlet, 1.0, 1000);
  for (std::size_t i = 0; i < start.size(); ++i) EXPECT_LT(glm::distance(start[i], sim.state.position[i]), 1e-12);
}

TEST(RestAngle, AFlatSheetAsBuiltIsTheFlatOneForSmallAngles) {
  TestSim built = flat_sheet({7, 5}, 0.02, 50.0);
  bend(built, 0.01, 0.4);
  TestSim flat = built;
  built.system.forces[0].values[2] = 1.0;
  const double energy = energy_as_built(flat);
  EXPECT_NEAR(energy_as_built(built), energy, 1e-5 * energy);
}

// The moment is proportional to the angle up to a fold of nearly 180 degrees: the energy of a hinge is B/2 c (t - t0)^2.
TEST(RestAngle, TheEnergyIsQuadraticInTheAngle) {
  const auto energy_of_fold = [](double angle) {
    TestSim sim = flat_sheet({3, 2}, 0.02, 50.0);
    sim.system.forces[0].values[2] = 1.0;
    sim.state.position[2] = Vec3(0.1 + 0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.0);
    sim.state.position[5] = sim.state.position[2] + Vec3(0.0, 0.0, 0.1);
    return energy_as_built(sim);
  };
  const double unit = energy_of_fold(1.0);
  EXPECT_GT(unit, 1e-3);
  for (const double angle : {-3.0, -1.5, 0.1, 2.0, 3.1}) EXPECT_NEAR(energy_of_fold(angle), unit * angle * angle, 1e-13 * angle * angle);
}

TEST(RestAngle, ForceIsMinusTheGradientOfTheEnergy) {
  TestSim sim = crumpled_strip(0.4);
  const Field f = force_as_built(sim);
  for (Index i = 0; i < sim.system.point_count(); ++i)
    for (int c = 0; c < 3; ++c) {
      constexpr double step = 1e-6;
      const double x = sim.state.position[static_cast<std::size_t>(i)][c];
      double& place = sim.state.position[static_cast<std::size_t>(i)][c];
      place = x + step;
      const double above = energy_as_built(sim);
      place = x - step;
      const double below = energy_as_built(sim);
      place = x;
      EXPECT_NEAR(f[static_cast<std::size_t>(c * sim.system.point_count() + i)], -(above - below) / (2.0 * step), 3e-7);
    }
}

TEST(RestAngle, ForcesConserveMomentumAndAngularMomentum) {
  for (const double damping_time : {0.0, 0.05}) {
    const TestSim sim = crumpled_strip(0.4, damping_time);
    const Field f = force_as_built(sim);
    const std::size_t n = sim.state.position.size();
    Vec3 sum(0.0), torque(0.0);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 force(f[i], f[n + i], f[2 * n + i]);
      sum += force;
      torque += glm::cross(sim.state.position[i], force);
    }
    EXPECT_GT(size_of(f), 0.1);
    EXPECT_LT(glm::length(sum), 1e-13 * size_of(f)) << damping_time;
    EXPECT_LT(glm::length(torque), 1e-13 * size_of(f)) << damping_time;
  }
}

TEST(RestAngle, TheDashpotDissipatesExceptInRigidMotion) {
  TestSim sim = crumpled_strip(0.4, 0.05);
  const Plan plan = make_plan(sim.system);
  const auto power = [&] {
    Motion motion;
    pack(plan, sim.state, motion);
    return bending_force.power(plan, plan.forces[0].values, 0.0, motion.x.data(), motion.v.data());
  };
  const double random_power = power();
  EXPECT_LT(random_power, -0.01);
  for (std::size_t i = 0; i < sim.state.position.size(); ++i)
    sim.state.velocity[i] = Vec3(0.3, -0.2, 0.1) + glm::cross(Vec3(1.0, -0.7, 0.4), sim.state.position[i]);
  EXPECT_LT(std::abs(power()), 1e-25 * std::abs(random_power) + 1e-25);
}

// -df/dx by central differences, against the blocks that implicit methods take.
TEST(RestAngle, ImplicitMethodsTakeTheExactDerivatives) {
  TestSim sim = crumpled_strip(0.4);
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  ForceTangent tangent;
  tangent.reset(plan);
  bending_force.add_tangent(plan, plan.forces[0].values, 0.0, motion.x.data(), motion.v.data(), tangent);
  const auto n = static_cast<std::size_t>(plan.points);
  double largest = 0.0;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t c = 0; c < 3; ++c) {
      constexpr double step = 1e-6;
      const auto force_at = [&](double shift) {
        Field x = motion.x, f(motion.x.size(), 0.0);
        x[c * n + j] += shift;
        bending_force.add(plan, plan.forces[0].values, 0.0, x.data(), motion.v.data(), f.data());
        return f;
      };
      const Field above = force_at(step), below = force_at(-step);
      for (Index k = plan.force_data.hinges.begin[j]; k < plan.force_data.hinges.begin[j + 1]; ++k) {
        const auto i = static_cast<std::size_t>(plan.force_data.hinges.column[static_cast<std::size_t>(k)]);
        if (i < j) continue;
        const glm::dmat3 block = tangent.hinges.block(k, 1.0, true);
        for (std::size_t r = 0; r < 3; ++r) {
          const double difference = -(above[r * n + i] - below[r * n + i]) / (2.0 * step);
          largest = std::max(largest, std::abs(difference));
          // of row j and column i: its component (c, r)
          EXPECT_NEAR(block[static_cast<int>(r)][static_cast<int>(c)], difference, 2e-5) << j << ' ' << i;
        }
      }
    }
  EXPECT_GT(largest, 10.0);
}

// The largest eigenvalue of M^-1/2 K M^-1/2 in the rest shape, K by differences.
TEST(RestAngle, TheEstimateIsAboveTheHighestFrequencyByAtMostAFactor) {
  for (const double angle : {0.1, 1.5}) {
    TestSim sim = folded_strip(9, angle, 0.02, 50.0, 0.01);
    const Plan plan = make_plan(sim.system);
    Motion motion;
    pack(plan, sim.state, motion);
    const Index n = plan.points;
    Eigen::MatrixXd k(3 * n, 3 * n);
    for (Index j = 0; j < 3 * n; ++j) {
      constexpr double step = 1e-7;
      const auto force_at = [&](double shift) {
        Field x = motion.x, f(motion.x.size(), 0.0);
        x[static_cast<std::size_t>(j)] += shift;
        bending_force.add(plan, plan.forces[0].values, 0.0, x.data(), motion.v.data(), f.data());
        return f;
      };
      const Field above = force_at(step), below = force_at(-step);
      for (Index i = 0; i < 3 * n; ++i)
        k(i, j) = -(above[static_cast<std::size_t>(i)] - below[static_cast<std::size_t>(i)]) / (2.0 * step) *
                  std::sqrt(plan.inverse_mass[static_cast<std::size_t>(i % n)] * plan.inverse_mass[static_cast<std::size_t>(j % n)]);
    }
    const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (k + k.transpose())).eigenvalues().maxCoeff();
    const ForceBound bound = bending_force.bound(sim.system, plan, sim.system.forces[0].values, 0.0);
    EXPECT_GE(bound.estimated_stiffness, largest) << angle;
    EXPECT_LE(bound.estimated_stiffness, 5.0 * largest) << angle;
    EXPECT_EQ(bound.stiffness, ForceBound::none);
    EXPECT_DOUBLE_EQ(bound.estimated_rate, 0.01 * bound.estimated_stiffness);
  }
}

// ---- every method

class RestAngleMethods : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, RestAngleMethods, testing::ValuesIn(every_method()), method_name);

// A folded strip that is flattened by a tenth and released.
TestSim stretched_strip(double damping_time) {
  TestSim sim = folded_strip(7, 1.2, 0.02, 50.0, damping_time);
  sim.system.gravity = Vec3(0.0);
  for (Vec3& x : sim.state.position) x.y *= 0.9;
  return sim;
}

TEST_P(RestAngleMethods, AgreeOnAFoldedStripThatVibrates) {
  for (const double damping_time : {0.0, 0.02}) {
    TestSim sim = stretched_strip(damping_time), exact = sim;
    exact.run(dop853, 0.1, 1, 1e-10);
    const double step = 0.2 * largest_stable_step(velocity_verlet, bound_spectrum(sim.system));
    const int steps = method().order == 1 ? 1500 : static_cast<int>(std::ceil(0.1 / step));
    sim.run(method(), 0.1, steps, 1e-8);
    double error = 0.0;
    for (std::size_t i = 0; i < sim.state.position.size(); ++i)
      error = std::max(error, glm::distance(sim.state.position[i], exact.state.position[i]));
    EXPECT_LT(error, method().order == 1 ? 8e-3 : 2e-4) << damping_time;
  }
}

TEST_P(RestAngleMethods, AreStableWithinTheirLimit) {
  TestSim sim = stretched_strip(0.002);
  initialize_supply(sim.system, sim.state);
  const double limit = largest_stable_step(method(), bound_spectrum(sim.system));
  if (limit == 0.0) return;  // amplifies undamped motion at any step, and the springs are undamped
  const int substeps = std::isfinite(limit) ? static_cast<int>(std::ceil(2.0 / 60.0 / limit)) : 1;
  for (int frame = 0; frame < 60; ++frame) {
    sim.run(method(), 1.0 / 60.0, substeps, 1e-4);
    ASSERT_FALSE(find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state))) << frame;
  }
}

// The energy of a strip that vibrates, with velocity Verlet: halving the step divides its error by 4.
TEST(RestAngle, EnergyIsConservedToTheOrderOfTheMethod) {
  const auto drift = [](int steps) {
    TestSim sim = stretched_strip(0.0);
    const auto energy = [&] { return compute_energy(sim.system, sim.state).total() + energy_as_built(sim); };
    const double start = energy();
    double worst = 0.0;
    for (int i = 0; i < 20; ++i) {
      sim.run(velocity_verlet, 0.05, steps);
      worst = std::max(worst, std::abs(energy() / start - 1.0));
    }
    return worst;
  };
  const double coarse = drift(200), fine = drift(400);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.3);
}

TEST(RestAngle, TheLedgerAccountsForTheWorkOfTheDashpots) {
  TestSim sim = stretched_strip(0.02);
  initialize_supply(sim.system, sim.state);
  const double start = compute_energy(sim.system, sim.state).total();
  sim.run(velocity_verlet, 1.0, 8000);
  const double end = compute_energy(sim.system, sim.state).total();
  EXPECT_LT(end, 0.7 * start);
  EXPECT_NEAR(end, sim.state.supply.net_input, 1e-3 * (start - end));
}

}  // namespace
}  // namespace hooke
