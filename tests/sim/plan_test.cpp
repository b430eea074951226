// The Plan: its runs, its values, and its bounds on the fastest rates of the scene.
#include "sim/plan/plan.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "sim/forces/motion.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// n x n points in rows, with springs to the right, down and along both diagonals.
TestSim grid(int n) {
  TestSim sim;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) sim.add({0.1 * column, -0.1 * row, 0.0});
  const auto join = [&](int row, int column, int down, int right) {
    const int r = row + down, c = column + right;
    if (r < n && c >= 0 && c < n) sim.join(sim.system.points()[row * n + column].id, sim.system.points()[r * n + c].id, 100.0, 0.1);
  };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      for (const auto& [down, right] : {std::pair{0, 1}, {1, 0}, {1, 1}, {1, -1}}) join(row, column, down, right);
  return sim;
}

// The spring of the System that each packed spring refers to, with the ends given by its run.
std::set<std::tuple<Index, Index, Index>> packed_springs(const Plan& plan) {
  std::set<std::tuple<Index, Index, Index>> springs;
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) springs.emplace(plan.spring.index[run.begin + e], run.first + e, run.second + e);
  return springs;
}

std::set<std::tuple<Index, Index, Index>> system_springs(const System& system) {
  std::set<std::tuple<Index, Index, Index>> springs;
  for (Index s = 0; s < system.spring_count(); ++s) {
    const Index i = system.index_of(system.springs()[s].first), j = system.index_of(system.springs()[s].second);
    springs.emplace(s, std::min(i, j), std::max(i, j));
  }
  return springs;
}

TEST(Plan, ContainsEverySpringOfAnyGraphOnce) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Index points = 2 + static_cast<Index>(seed);
    const System system = random_sim(seed, points, 3 * points).system;
    const Plan plan = make_plan(system);
    EXPECT_EQ(plan.spring.index.size(), system.springs().size());
    EXPECT_EQ(packed_springs(plan), system_springs(system)) << "seed " << seed;
  }
  const System cloth = grid(9).system;
  EXPECT_EQ(packed_springs(make_plan(cloth)), system_springs(cloth));
}

TEST(Plan, StoresRunsContiguously) {
  const Plan plan = make_plan(grid(9).system);
  Index begin = 0;
  for (const SpringRun& run : plan.spring.runs) {
    EXPECT_EQ(run.begin, begin);
    EXPECT_GT(run.count, 0);
    EXPECT_GE(run.first, 0);
    EXPECT_LE(run.second + run.count, plan.points);
    begin += run.count;
  }
  EXPECT_EQ(begin, plan.springs);
}

// springs along a row in one direction have consecutive ends
TEST(Plan, RecognizesTheRowsOfAGrid) {
  const Plan plan = make_plan(grid(32).system);
  EXPECT_LE(plan.spring.runs.size(), 4 * 32);
}

TEST(Plan, StoresTheValuesOfEachSpring) {
  TestSim sim = random_sim(7, 20, 60, 3, 5.0);
  Plan plan = make_plan(sim.system);
  const auto expect_values = [&] {
    for (Index s = 0; s < plan.springs; ++s) {
      const Spring& spring = sim.system.springs()[plan.spring.index[s]];
      EXPECT_EQ(plan.spring.stiffness[s], spring.stiffness);
      EXPECT_EQ(plan.spring.rest_length[s], spring.rest_length);
      EXPECT_EQ(plan.spring.damping[s], spring.damping);
    }
  };
  expect_values();

  // refreshed in place after edits of values
  for (Index s = 0; s < sim.system.spring_count(); ++s) {
    sim.system.spring(s)->stiffness *= 2.0;
    sim.system.spring(s)->rest_length += 0.1;
    sim.system.spring(s)->damping *= 0.5;
  }
  sim.system.point(3).nailed = !sim.system.point(3).nailed;
  refresh_values(plan, sim.system);
  expect_values();
  for (Index i = 0; i < plan.points; ++i)
    EXPECT_EQ(plan.inverse_mass[i], sim.system.points()[i].nailed ? 0.0 : 1.0 / sim.system.points()[i].mass);
}

TEST(Plan, ContainsOnlyWhatTheSceneNeeds) {
  TestSim sim = random_sim(8, 10, 20, 3, 5.0);
  sim.system.drag = 2.0;
  sim.system.colliders = {{.shape = Plane{}, .solid = false}};
  sim.system.switches.drag = sim.system.switches.dashpots = false;
  const Plan plan = make_plan(sim.system);
  EXPECT_FALSE(plan.has_dashpots());
  EXPECT_EQ(plan.drag, 0.0);
  EXPECT_TRUE(plan.colliders.empty());
  EXPECT_TRUE(plan.radius.empty());
}

TEST(Plan, OfAnEmptySceneIsEmpty) {
  const Plan plan = make_plan(System{});
  EXPECT_TRUE(plan.spring.runs.empty());
  EXPECT_EQ(plan.spectrum.omega, 0.0);
  EXPECT_EQ(plan.spectrum.dashpot_rate, 0.0);
}

// The largest eigenvalue of M^-1/2 A M^-1/2 over the free points, where spring s adds blocks +-block(s) to A.
template <class Block>
double highest_eigenvalue(const TestSim& sim, Block block) {
  const Index n = sim.system.point_count();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  const auto inverse_root = [&](Index i) {
    const Point& point = sim.system.points()[i];
    return point.nailed ? 0.0 : 1.0 / std::sqrt(point.mass);
  };
  for (const Spring& spring : sim.system.springs()) {
    const Index i = sim.system.index_of(spring.first), j = sim.system.index_of(spring.second);
    const Vec3 along = sim.state.position[i] - sim.state.position[j];
    const Eigen::Matrix3d b = block(spring, Eigen::Vector3d(along.x, along.y, along.z));
    for (const auto& [row, column, sign] : {std::tuple{i, i, 1.0}, {j, j, 1.0}, {i, j, -1.0}, {j, i, -1.0}})
      matrix.block<3, 3>(3 * row, 3 * column) += sign * inverse_root(row) * inverse_root(column) * b;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

// k u u^T + k (1 - l0 / l)(I - u u^T)
Eigen::Matrix3d stiffness_block(const Spring& spring, const Eigen::Vector3d& along) {
  const double length = along.norm();
  const Eigen::Vector3d u = along / length;
  const Eigen::Matrix3d lengthwise = u * u.transpose();
  return spring.stiffness * (lengthwise + (1.0 - spring.rest_length / length) * (Eigen::Matrix3d::Identity() - lengthwise));
}

Eigen::Matrix3d dashpot_block(const Spring& spring, const Eigen::Vector3d& along) {
  return spring.damping * along * along.transpose() / along.squaredNorm();
}

TEST(Spectrum, IsNeverBelowTheTrueRatesForAnyDeformation) {
  double tightest = 1e300;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    TestSim sim = random_sim(seed, 12, 30, 3, 5.0);
    for (const double stretch : {0.2, 1.0, 20.0}) {
      TestSim stretched = sim;
      for (Vec3& x : stretched.state.position) x *= stretch;
      const Spectrum spectrum = bound_spectrum(stretched.system);
      const double omega = std::sqrt(highest_eigenvalue(stretched, stiffness_block));
      EXPECT_GE(spectrum.omega * (1.0 + 1e-12), omega) << "seed " << seed << ", stretch " << stretch;
      EXPECT_GE(spectrum.dashpot_rate * (1.0 + 1e-12), highest_eigenvalue(stretched, dashpot_block)) << "seed " << seed;
      tightest = std::min(tightest, spectrum.omega / omega);
    }
  }
  EXPECT_LT(tightest, 1.5);
}

TEST(Spectrum, IsExactForOneSpring) {
  TestSim sim;
  const PointId first = sim.add({0.0, 0.0, 0.0}, 0.5), second = sim.add({1.0, 0.0, 0.0}, 0.5);
  sim.join(first, second, 9.0, 1.0, 3.0);
  // w^2 = k (1/m1 + 1/m2)
  EXPECT_DOUBLE_EQ(bound_spectrum(sim.system).omega, 6.0);
  EXPECT_DOUBLE_EQ(bound_spectrum(sim.system).dashpot_rate, 12.0);

  sim.system.point(0).nailed = true;
  EXPECT_DOUBLE_EQ(bound_spectrum(sim.system).omega, std::sqrt(18.0));
  EXPECT_DOUBLE_EQ(bound_spectrum(sim.system).dashpot_rate, 6.0);
}

TEST(Spectrum, IncludesThePullOfTheHand) {
  TestSim sim;
  const PointId point = sim.add(Vec3(0.0), 0.25);
  sim.system.grab = Grab{.point = point, .kind = GrabKind::Pull, .stiffness = 100.0};
  EXPECT_DOUBLE_EQ(bound_spectrum(sim.system).omega, 20.0);
}

}  // namespace
}  // namespace hooke
