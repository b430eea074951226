// The bound on the frequencies in a state: never below the highest frequency, and close to it for chains and nets.
#include "sim/automatic/frequency_bound.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "sim/forces/forces.h"
#include "support/nets.h"

namespace hooke {
namespace {

// [rad/s], from the eigenvalues of the stiffness matrix, by differences of the forces.
double highest_frequency(const Plan& plan, const State& state) {
  Motion motion;
  pack(plan, state, motion);
  const auto n = static_cast<Eigen::Index>(motion.x.size());
  const double step = 1e-6;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  Field forward(motion.x.size()), backward(motion.x.size());
  for (Eigen::Index column = 0; column < n; ++column) {
    const auto at = static_cast<std::size_t>(column);
    const double x = motion.x[at];
    motion.x[at] = x + step;
    compute_position_forces(plan, 0.0, motion.x, motion.v, forward);
    motion.x[at] = x - step;
    compute_position_forces(plan, 0.0, motion.x, motion.v, backward);
    motion.x[at] = x;
    for (Eigen::Index row = 0; row < n; ++row) {
      const auto to = static_cast<std::size_t>(row);
      const double weight = std::sqrt(plan.inverse_mass[to % plan.points] * plan.inverse_mass[at % plan.points]);
      matrix(row, column) = -weight * (forward[to] - backward[to]) / (2.0 * step);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (matrix + matrix.transpose()), Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

double bound_of(const TestSim& sim) {
  const Plan plan = make_plan(sim.system);
  return plan.spectrum.omega * FrequencyBound().relative(plan, sim.state, 0.0);
}

TEST(FrequencyBound, IsCloseToTheHighestFrequencyOfANetAtRest) {
  TestSim sim = net(8, 1e4, 0.0);
  for (Vec3& v : sim.state.velocity) v = Vec3(0.0);
  const double highest = highest_frequency(make_plan(sim.system), sim.state), bound = bound_of(sim);
  EXPECT_GE(bound, highest);
  EXPECT_LE(bound, 1.06 * highest);
  EXPECT_GE(make_plan(sim.system).spectrum.omega, 1.3 * highest);
}

TEST(FrequencyBound, IsNeverBelowTheHighestFrequencyOfARandomNet) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    const auto number = [&](double min, double max) { return min + (max - min) * static_cast<double>(random()) / 4294967295.0; };
    TestSim sim;
    std::vector<PointId> ids;
    for (int i = 0; i < 10; ++i)
      ids.push_back(i == 0 ? sim.nail(Vec3(0.0)) : sim.add({number(-1, 1), number(-1, 1), number(-1, 1)}, number(0.1, 3.0)));
    for (std::size_t i = 1; i < ids.size(); ++i)
      for (int j = 0; j < 3; ++j)
        if (const PointId other = ids[random() % i]; other != ids[i]) sim.join(ids[i], other, number(1, 1e3), number(0.1, 1.5));
    EXPECT_GE(bound_of(sim), highest_frequency(make_plan(sim.system), sim.state) * (1.0 - 1e-6)) << seed;
  }
}

// Springs that turn within the time may become parallel: then it is the bound for every deformation.
TEST(FrequencyBound, AllowsForSpringsThatTurn) {
  TestSim sim = net(8, 1e4, 0.0);
  const Plan plan = make_plan(sim.system);
  for (std::size_t i = 0; i < sim.state.velocity.size(); ++i) sim.state.velocity[i] = Vec3(0.0, 0.0, i % 2 == 0 ? 5.0 : -5.0);
  EXPECT_LT(FrequencyBound().relative(plan, sim.state, 0.0), 0.8);
  EXPECT_GT(FrequencyBound().relative(plan, sim.state, 0.1), 0.99);
}

}  // namespace
}  // namespace hooke
