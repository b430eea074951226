// The matrix of an implicit step and its solver, against finite differences of forces and dense linear algebra.
#include "sim/methods/implicit/stiffness.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "sim/forces/forces.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr double b = 0.01;

Motion packed(const Plan& plan, const TestSim& sim) {
  Motion motion;
  pack(plan, sim.state, motion);
  return motion;
}

// M (V (1 + b c)) - b f(x + b V, V) at free points
Field residual(const Plan& plan, const Field& x, const Field& V) {
  Field moved = x, f(x.size()), r(x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) moved[i] += b * V[i];
  compute_forces(plan, 0.0, moved, V, f);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t point = i % plan.points;
    r[i] = plan.inverse_mass[point] == 0.0 ? V[i] * plan.mass[point] * (1.0 + b * plan.drag) : plan.mass[point] * V[i] - b * f[i];
  }
  return r;
}

// A^-1 (dR/dV e) = e for every unit vector e of a free point. At V = 0 the omitted part of the dashpots is zero.
void expect_derivative(const TestSim& sim) {
  Plan plan = make_plan(sim.system);
  Motion motion = packed(plan, sim);
  if (plan.hand.pull) plan.hand.pull->from = sim.state.hand.position;
  Field V(motion.x.size(), 0.0);
  StiffnessMatrix matrix(plan);
  matrix.assemble(plan, b, motion.x, V, Curvature::Exact);
  ASSERT_TRUE(matrix.factorize());

  constexpr double small = 1e-4;
  for (std::size_t i = 0; i < V.size(); ++i) {
    if (plan.inverse_mass[i % plan.points] == 0.0) continue;
    V[i] = small;
    Field column = residual(plan, motion.x, V);
    V[i] = -small;
    const Field other = residual(plan, motion.x, V);
    V[i] = 0.0;
    for (std::size_t j = 0; j < column.size(); ++j) column[j] = (column[j] - other[j]) / (2.0 * small);
    matrix.solve(column);
    for (std::size_t j = 0; j < column.size(); ++j) EXPECT_NEAR(column[j], i == j ? 1.0 : 0.0, 1e-7);
  }
}

TEST(StiffnessMatrix, IsTheDerivativeOfTheForces) {
  for (const int dimensions : {2, 3})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      TestSim sim = random_sim(seed, 12, 30, dimensions, 3.0);
      sim.system.drag = 0.7;
      expect_derivative(sim);
    }
}

TEST(StiffnessMatrix, IncludesTheGrab) {
  for (const GrabKind kind : {GrabKind::Pull, GrabKind::Hold}) {
    TestSim sim = random_sim(7, 12, 30);
    Index free = 0;
    while (sim.system.points()[free].nailed) ++free;
    sim.system.grab = Grab{.point = sim.system.points()[free].id, .kind = kind, .stiffness = 500.0};
    expect_derivative(sim);
  }
}

// k (l0 - l) / l = 8 in the transverse direction, k along the spring: the exact matrix is indefinite, the clamped one has zeros for the
// negative eigenvalues
TEST(StiffnessMatrix, ClampedIsTheNearestPositiveSemidefiniteMatrix) {
  TestSim sim;
  const Vec3 u(0.48, 0.6, 0.64);
  const PointId first = sim.add(Vec3(0.0), 1.0), second = sim.add(0.1 * u, 2.0);
  const double k = 3e4, l0 = 0.9;
  sim.join(first, second, k, l0);
  const Plan plan = make_plan(sim.system);
  const Motion motion = packed(plan, sim);

  Eigen::Matrix<double, 6, 6> stiffness;
  const Eigen::Vector3d along(u.x, u.y, u.z);
  const Eigen::Matrix3d block =
      k * along * along.transpose() + k * (1.0 - l0 / 0.1) * (Eigen::Matrix3d::Identity() - along * along.transpose());
  stiffness << block, -block, -block, block;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(stiffness);
  EXPECT_LT(eigen.eigenvalues()[0], -1e5);
  const Eigen::Matrix<double, 6, 6> clamped =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
  Eigen::Matrix<double, 6, 6> mass = Eigen::Matrix<double, 6, 6>::Identity();
  mass.bottomRightCorner<3, 3>() *= 2.0;

  StiffnessMatrix matrix(plan);
  matrix.assemble(plan, b, motion.x, motion.v, Curvature::Exact);
  EXPECT_FALSE(matrix.factorize());
  matrix.assemble(plan, b, motion.x, motion.v, Curvature::Clamped);
  ASSERT_TRUE(matrix.factorize());
  Eigen::Matrix<double, 6, 1> right;
  right << 1.0, -2.0, 0.5, 0.3, 0.7, -1.1;
  const Eigen::Matrix<double, 6, 1> expected = (mass + b * b * clamped).ldlt().solve(right);
  Field tried(6);
  for (int point = 0; point < 2; ++point)
    for (int c = 0; c < 3; ++c) tried[2 * c + point] = right[3 * point + c];
  matrix.solve(tried);
  for (int point = 0; point < 2; ++point)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(tried[2 * c + point], expected[3 * point + c], 1e-12);
}

// k I, with or without a rest length, because there is no direction along the spring
TEST(StiffnessMatrix, OfCoincidentPointsIsIsotropic) {
  for (const double l0 : {0.0, 1.0}) {
    TestSim sim;
    const PointId point = sim.add(Vec3(0.3), 2.0);
    sim.join(sim.nail(Vec3(0.3)), point, 5e4, l0, 1.0);
    const Plan plan = make_plan(sim.system);
    const Motion motion = packed(plan, sim);
    StiffnessMatrix matrix(plan);
    matrix.assemble(plan, b, motion.x, motion.v, Curvature::Exact);
    ASSERT_TRUE(matrix.factorize());
    Field right(6, 1.0);
    matrix.solve(right);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(right[2 * c], 1.0 / (2.0 + b * b * 5e4), 1e-15);
  }
}

using Pairs = std::vector<std::pair<Index, Index>>;

// Solves a system with random blocks and compares with a dense solver.
void expect_solution(Index points, int dimensions, const Pairs& couplings) {
  Random random(11);
  LinearSolver solver(points, dimensions, couplings);

  // a dominant diagonal and symmetric off-diagonal blocks
  const int n = points * dimensions;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < points; ++i)
    for (int c = 0; c < dimensions; ++c)
      for (int r = 0; r <= c; ++r) {
        const double value = r == c ? 100.0 + 4.0 * points : random.uniform(-1.0, 1.0);
        solver.diagonal(i).column(c)[r] += value;
        dense(i + r * points, i + c * points) += value;
        if (r != c) dense(i + c * points, i + r * points) += value;
      }
  for (const auto& coupling : couplings) {
    const auto i = coupling.first, j = coupling.second;
    for (int c = 0; c < dimensions; ++c)
      for (int r = 0; r <= c; ++r) {
        const double value = random.uniform(-1.0, 1.0);
        const auto add = [&](int row, int column) {
          solver.coupling(i, j).column(column)[row] += value;
          dense(i + row * points, j + column * points) += value;
          dense(j + column * points, i + row * points) += value;
        };
        add(r, c);
        if (r != c) add(c, r);
      }
  }

  ASSERT_TRUE(solver.factorize());
  Field right(n);
  for (double& value : right) value = random.uniform(-1.0, 1.0);
  const Eigen::VectorXd expected = dense.ldlt().solve(Eigen::Map<Eigen::VectorXd>(right.data(), n));
  solver.solve(right);
  for (int i = 0; i < n; ++i) ASSERT_NEAR(right[i], expected[i], 1e-14);
}

TEST(LinearSolver, SolvesAnyGraph) {
  Random random(11);
  Pairs few, grid, all, star;
  for (int e = 0; e < 120; ++e) {
    const Index i = random.below(40), j = random.below(39);
    few.emplace_back(i, j < i ? j : j + 1);
  }
  constexpr Index width = 18, complete = 90, leaves = 50;
  for (Index i = 0; i < width * width; ++i) {
    if (i % width + 1 < width) grid.emplace_back(i, i + 1);
    if (i + width < width * width) grid.emplace_back(i + width, i);
  }
  // more than one dense block is wide
  for (Index i = 0; i < complete; ++i)
    for (Index j = 0; j < i; ++j) all.emplace_back(i, j);
  for (Index i = 1; i <= leaves; ++i) star.emplace_back(0, i);
  for (const int dimensions : {2, 3}) {
    expect_solution(1, dimensions, {});
    expect_solution(7, dimensions, {});
    expect_solution(40, dimensions, few);
    expect_solution(width * width, dimensions, grid);
    expect_solution(complete, dimensions, all);
    expect_solution(leaves + 1, dimensions, star);
  }
}

TEST(LinearSolver, ReportsAMatrixThatIsNotPositiveDefinite) {
  LinearSolver solver(2, 2, Pairs{{0, 1}});
  for (Index i = 0; i < 2; ++i)
    for (int c = 0; c < 2; ++c) solver.diagonal(i).column(c)[c] = 1.0;
  EXPECT_TRUE(solver.factorize());
  solver.coupling(1, 0).column(0)[0] = -2.0;
  EXPECT_FALSE(solver.factorize());
  solver.set_zero();
  EXPECT_FALSE(solver.factorize());
}

}  // namespace
}  // namespace hooke
