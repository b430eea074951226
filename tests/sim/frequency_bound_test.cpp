// The bound on the frequencies in a state: never below the highest frequency, and close to it for chains and nets.
#include "sim/step/automatic/frequency_bound.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "sim/forces/forces.h"
#include "support/nets.h"
#include "support/random_scene.h"

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
    const TestSim sim = random_sim(seed, 10, 27);
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
