// Bending against the theory of plates: energies of cylinders, the heavy elastica, beams and sheets on supports. With HOOKE_PRINT set, the
// tables of docs/reference/bending.md are printed.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "sim/forces/forces.h"
#include "sim/forces/terms/rows.h"
#include "sim/methods/rows.h"
#include "sim/plan/hinges.h"
#include "support/bent_sheet.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

double bending_energy(const TestSim& sim) {
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  return bending_force.potential(plan, plan.forces[0].values, 0.0, motion.x.data());
}

// The energy of a cell within a bent sheet, relative to that of a plate: the second difference over the number of cells, without borders.
double relative_energy(double cell, double angle, Diagonals diagonals, double aspect = 1.0) {
  constexpr double stiffness = 0.01, curvature = 0.01;
  const auto energy = [&](int cells) {
    TestSim sim = flat_sheet({cells + 1, cells + 1, cell, aspect * cell}, stiffness, 100.0, diagonals);
    bend(sim, curvature, angle);
    return bending_energy(sim);
  };
  return (energy(12) - 2.0 * energy(8) + energy(4)) / 32.0 / (0.5 * stiffness * curvature * curvature * aspect * cell * cell);
}

TEST(Bending, ACylinderHasTheEnergyOfAPlateForEveryResolutionAndDirection) {
  for (const double cell : {0.1, 0.02})
    for (const double aspect : {1.0, 0.4})
      for (const double angle : {0.0, 0.4, 0.7853981633974483, 1.2, 1.5707963267948966, 2.0, 2.356194490192345})
        for (const Diagonals diagonals : {Diagonals::Falling, Diagonals::Rising})
          EXPECT_NEAR(relative_energy(cell, angle, diagonals, aspect), 1.0, 2e-5) << cell << ' ' << aspect << ' ' << angle;
}

// Alternating diagonals make no parallelograms of adjacent faces.
TEST(Bending, AlternatingDiagonalsAreStifferAcrossTheThreads) {
  for (const double angle : {0.0, 0.4, 0.7853981633974483, 1.2}) {
    const double twist = std::sin(2.0 * angle);
    EXPECT_NEAR(relative_energy(0.05, angle, Diagonals::Alternating), 1.0 + 0.5 * twist * twist, 2e-5) << angle;
  }
}

TEST(Bending, AStripHasTheEnergyOfItsWholeWidth) {
  constexpr double curvature = 0.01;
  TestSim sim = flat_sheet({11, 3, 0.1, 0.07}, 0.01, 100.0);
  bend(sim, curvature, 0.0);
  // without half a cell at either end, where nothing bends
  EXPECT_NEAR(bending_energy(sim), 0.5 * 0.01 * curvature * curvature * 0.14 * 0.9, 1e-5 * bending_energy(sim));
}

// Crumpled at random by up to this part of a cell.
TestSim crumpled_sheet(double part, double damping_time, std::uint64_t seed = 1) {
  TestSim sim = flat_sheet({6, 5}, 0.02, 50.0, Diagonals::Alternating, damping_time);
  Random random(seed);
  for (Vec3& x : sim.state.position)
    x += 0.1 * part * Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  for (Vec3& v : sim.state.velocity) v = Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  return sim;
}

Field listed_force(const TestSim& sim) {
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  Field f(motion.x.size(), 0.0);
  add_force_terms(plan, 0.0, motion.x, motion.v, f);
  return f;
}

Vec3 vector_of(const Field& f, std::size_t points, std::size_t i) { return {f[i], f[points + i], f[2 * points + i]}; }

TEST(Bending, ForceIsMinusTheGradientOfTheEnergy) {
  TestSim sim = crumpled_sheet(0.5, 0.0);
  const Field f = listed_force(sim);
  for (Index i = 0; i < sim.system.point_count(); i += 7)
    for (int c = 0; c < 3; ++c) {
      constexpr double step = 1e-6;
      const double x = sim.state.position[i][c];
      sim.state.position[i][c] = x + step;
      const double above = bending_energy(sim);
      sim.state.position[i][c] = x - step;
      const double below = bending_energy(sim);
      sim.state.position[i][c] = x;
      EXPECT_NEAR(f[static_cast<std::size_t>(c * sim.system.point_count() + i)], -(above - below) / (2.0 * step), 1e-7);
    }
}

TEST(Bending, ForcesConserveMomentumAndAngularMomentum) {
  for (const double damping_time : {0.0, 0.05}) {
    const TestSim sim = crumpled_sheet(0.5, damping_time);
    const Field f = listed_force(sim);
    const std::size_t n = sim.state.position.size();
    Vec3 sum(0.0), torque(0.0);
    double size = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += vector_of(f, n, i);
      torque += glm::cross(sim.state.position[i], vector_of(f, n, i));
      size += glm::length(vector_of(f, n, i));
    }
    EXPECT_GT(size, 1.0);
    EXPECT_LT(glm::length(sum), 1e-14 * size) << damping_time;
    EXPECT_LT(glm::length(torque), 1e-14 * size) << damping_time;
  }
}

TEST(Bending, TheDashpotDissipatesExceptInRigidMotion) {
  TestSim sim = crumpled_sheet(0.5, 0.05);
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

// The largest eigenvalue of M^-1/2 K M^-1/2.
Eigen::MatrixXd hinge_matrix(const TestSim& sim) {
  const Plan plan = make_plan(sim.system);
  const Index n = plan.points;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index e = plan.force_data.hinges.begin[i]; e < plan.force_data.hinges.begin[i + 1]; ++e)
      k(i, plan.force_data.hinges.column[e]) = plan.forces[0].values[0] * plan.force_data.hinges.value[e] *
                                               std::sqrt(plan.inverse_mass[i]) *
                                               std::sqrt(plan.inverse_mass[plan.force_data.hinges.column[e]]);
  return k;
}

TEST(Bending, TheBoundIsAboveTheHighestFrequencyByAtMostAFactor) {
  for (const Diagonals diagonals : {Diagonals::Falling, Diagonals::Rising, Diagonals::Alternating}) {
    const TestSim sim = flat_sheet({12, 9, 0.1, 0.07}, 0.02, 50.0, diagonals, 0.01);
    const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(hinge_matrix(sim)).eigenvalues().maxCoeff();
    const ForceBound bound = bending_force.bound(sim.system, make_plan(sim.system), sim.system.forces[0].values, 0.0);
    EXPECT_GE(bound.stiffness, largest);
    EXPECT_LE(bound.stiffness, 2.0 * largest);
    EXPECT_DOUBLE_EQ(bound.estimated_rate, 0.01 * bound.stiffness);
    EXPECT_EQ(bound.omitted_stiffness, 0.0);
  }
}

// ---- plates

// omega = 1.875104^2 sqrt(B / (rho l^4))
double beam_frequency_error(int columns, Diagonals diagonals) {
  const double stiffness = 0.01, exact = 3.51601526850015 * std::sqrt(stiffness / 0.1);
  const Eigen::MatrixXd k = hinge_matrix(clamped_strip(columns, stiffness, 100.0, diagonals));
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  // a nailed point has a zero row
  return std::sqrt(values[4]) / exact - 1.0;
}

TEST(Bending, ABeamVibratesAtItsFrequencyWithSecondOrderInTheCells) {
  for (const Diagonals diagonals : {Diagonals::Falling, Diagonals::Rising, Diagonals::Alternating}) {
    std::array<double, 3> error{};
    for (int level = 0; level < 3; ++level) error[level] = beam_frequency_error((8 << level) + 1, diagonals);
    if (std::getenv("HOOKE_PRINT") != nullptr)
      std::printf("| frequency of a clamped strip | %.2e | %.2e | %.2e |\n", error[0], error[1], error[2]);
    EXPECT_LT(std::abs(error[2]), 2e-3);
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.25);
  }
}

// A clamped strip, displaced from rest by its slowest mode, without gravity.
struct Vibration {
  TestSim sim;
  double omega = 0.0;  // [rad/s], undamped
  double tip() const { return sim.state.position[8].y; }
};
Vibration vibrating_strip(double amplitude, double damping_time) {
  Vibration result{clamped_strip(9, 0.01, 100.0)};
  TestSim& sim = result.sim;
  sim.system.gravity = Vec3(0.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(hinge_matrix(sim));
  result.omega = std::sqrt(modes.eigenvalues()[4]);
  sim.system.forces[0].values[1] = damping_time;
  const auto shape = [&](Index i) { return modes.eigenvectors()(i, 4) / std::sqrt(sim.system.points()[i].mass); };
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.state.position[i].y = amplitude * shape(i) / shape(8);
  return result;
}

TEST(Bending, TheDampingTimeGivesTheDampingRatioOfAVibration) {
  constexpr double damping_time = 0.1, amplitude = 1e-5, seconds = 2.0;
  Vibration strip = vibrating_strip(amplitude, damping_time);
  const double ratio = 0.5 * strip.omega * damping_time, rate = ratio * strip.omega, damped = strip.omega * std::sqrt(1.0 - ratio * ratio);
  strip.sim.run(dop853, seconds, 1, 1e-12);
  EXPECT_GT(ratio, 0.05);
  EXPECT_NEAR(strip.tip(),
              amplitude * std::exp(-rate * seconds) * (std::cos(damped * seconds) + rate / damped * std::sin(damped * seconds)),
              1e-4 * amplitude);
}

// x' = x (1 + h T w^2) / (1 + h T w^2 + h^2 w^2) for a step of implicit Euler, of which one Newton step finds the solution if the matrix is
// that of the forces.
TEST(Bending, ImplicitMethodsHaveTheExactDerivatives) {
  constexpr double amplitude = 1e-6, h = 0.5;
  for (const double damping_time : {0.0, 0.3})
    for (const Integrator* method : {&baraff_witkin, &implicit_euler}) {
      Vibration strip = vibrating_strip(amplitude, damping_time);
      const double square = strip.omega * strip.omega, damping = h * damping_time * square;
      strip.sim.run(*method, h, 1);
      EXPECT_NEAR(strip.tip(), amplitude * (1.0 + damping) / (1.0 + damping + h * h * square), 1e-6 * amplitude) << method->id;
    }
}

// w = 5 rho g l^4 / (384 B) in the middle
double deflection_error(int columns, Diagonals diagonals) {
  constexpr double stiffness = 0.01;
  TestSim sim = flat_sheet({columns, 5, 1.0 / (columns - 1), 0.1}, stiffness, 100.0, diagonals);
  const Index n = sim.system.point_count();
  for (Index i = 0; i < n; ++i) sim.system.point(i).nailed = i % columns == 0 || i % columns == columns - 1;
  Eigen::MatrixXd k = hinge_matrix(sim);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(n);
  for (Index i = 0; i < n; ++i) {
    if (sim.system.points()[i].nailed)
      k(i, i) = 1.0;
    else
      load[i] = std::sqrt(sim.system.points()[i].mass) * 9.81;
  }
  const Eigen::VectorXd y = k.ldlt().solve(load);
  const Index middle = 2 * columns + columns / 2;
  return y[middle] / std::sqrt(sim.system.points()[middle].mass) / (5.0 * 0.1 * 9.81 / (384.0 * stiffness)) - 1.0;
}

TEST(Bending, ASheetOnTwoSupportsSagsAsAPlateWithSecondOrderInTheCells) {
  for (const Diagonals diagonals : {Diagonals::Falling, Diagonals::Rising, Diagonals::Alternating}) {
    std::array<double, 3> error{};
    for (int level = 0; level < 3; ++level) error[level] = deflection_error((8 << level) + 1, diagonals);
    if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("| sag on two supports | %.2e | %.2e | %.2e |\n", error[0], error[1], error[2]);
    EXPECT_LT(std::abs(error[2]), 2e-3);
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.1);
  }
}

// The heavy elastica, clamped horizontally, of length 1 and gravito-bending number G = rho g l^3 / B: its angle p to the vertical at the
// distance r from its free end has p'' = G r sin p, p' = 0 at r = 0 and p = pi / 2 at r = 1. The logarithm of the angle at the end is
// bisected.
Vec3 elastica_tip(double number) {
  struct At {
    double angle, slope, x, y;
  };
  const double right_angle = std::acos(0.0);
  const auto shoot = [&](double log_angle) {
    constexpr int steps = 2000;
    constexpr double h = 1.0 / steps;
    const auto rates = [&](const At& u, double r) {
      return At{u.slope, number * r * std::sin(u.angle), std::sin(u.angle), -std::cos(u.angle)};
    };
    const auto add = [](const At& u, const At& rate, double s) {
      return At{u.angle + s * rate.angle, u.slope + s * rate.slope, u.x + s * rate.x, u.y + s * rate.y};
    };
    At at{.angle = std::exp(log_angle), .slope = 0.0, .x = 0.0, .y = 0.0};
    for (int i = 0; i < steps && at.angle < 2.0 * right_angle; ++i) {
      const double r = i * h;
      const At k1 = rates(at, r), k2 = rates(add(at, k1, 0.5 * h), r + 0.5 * h), k3 = rates(add(at, k2, 0.5 * h), r + 0.5 * h),
               k4 = rates(add(at, k3, h), r + h);
      at = add(add(add(add(at, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
    }
    return at;
  };
  double low = -std::sqrt(number) - 10.0, high = std::log(right_angle);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(middle).angle < right_angle ? low : high) = middle;
  }
  const At at = shoot(low);
  return {at.x, at.y, 0.0};
}

TEST(Bending, TheElasticaHasTheLimitsOfABeamAndOfAHangingThread) {
  EXPECT_NEAR(elastica_tip(0.01).y, -0.01 / 8.0, 1e-8);
  EXPECT_NEAR(elastica_tip(1e5).x, std::sqrt(2.0 / 1e5), 2e-5);
}

double elastica_error(double number, int columns) {
  TestSim sim = clamped_strip(columns, 0.1 * 9.81 / number, 1e5);
  for (const double h : {0.01, 0.03, 0.2, 1.0}) sim.run(implicit_euler, 40.0 * h, 40);
  const Vec3 tip = sim.state.position[static_cast<std::size_t>(columns) - 1] - Vec3(0.5 / (columns - 1.5), 0.0, 0.0);
  return glm::distance(Vec3(tip.x, tip.y, 0.0), elastica_tip(number));
}

TEST(Bending, AClampedStripIsTheHeavyElasticaWithSecondOrderInTheCells) {
  const bool is_printed = std::getenv("HOOKE_PRINT") != nullptr;
  for (const double number : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
    std::array<double, 3> error{};
    const int levels = is_printed || number == 10.0 ? 3 : 2;
    for (int level = 0; level < levels; ++level) error[level] = elastica_error(number, (8 << level) + 1);
    if (is_printed) std::printf("| %g | %.2e | %.2e | %.2e |\n", number, error[0], error[1], error[2]);
    EXPECT_LT(error[1], number > 100.0 ? 2e-2 : 5e-3) << number;
    for (int level = 1; level < levels; ++level) EXPECT_NEAR(std::log2(error[level - 1] / error[level]), 2.0, 0.4) << number;
  }
}

}  // namespace
}  // namespace hooke
