// The terms of the stretch of springs against closed forms.
#include "study/check/stretch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/methods/integrator.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

constexpr double g = 9.81;
const Progress always = [](double) { return true; };

// n masses m below each other on springs k, at their rest lengths.
TestSim hanging_chain(int n, double m, double k, double l0) {
  TestSim sim;
  sim.system.gravity = {0.0, -g, 0.0};
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i <= n; ++i) {
    const PointId next = sim.add({0.0, -l0 * i, 0.0}, m);
    sim.join(last, next, k, l0, 0.0);
    last = next;
  }
  return sim;
}

std::vector<SpringId> all_springs(const System& system) {
  std::vector<SpringId> ids;
  for (const Spring& spring : system.springs()) ids.push_back(spring.id);
  return ids;
}

TEST(Stretch, TheLoadIsTheWeightBelowOverTheStiffnessAndTheRestIsMotion) {
  const TestSim sim = hanging_chain(5, 0.2, 100.0, 0.1);
  const StretchBreakdown top = explain_stretch(sim.system, sim.state, {}, {sim.system.springs()[0].id}, always);
  ASSERT_TRUE(top.load && top.solver && top.motion && top.step_error) << top.why_no_load;
  EXPECT_NEAR(*top.load, 5.0 * 0.2 * g / 100.0 / 0.1, 1e-6);
  EXPECT_NEAR(*top.solver, 0.0, 1e-6);
  EXPECT_EQ(top.limit, std::nullopt);
  EXPECT_NEAR(top.now, 0.0, 1e-12);
  EXPECT_NEAR(*top.motion, -*top.load, 1e-5);
  const StretchBreakdown mean = explain_stretch(sim.system, sim.state, {}, all_springs(sim.system), always);
  EXPECT_NEAR(*mean.load, 3.0 * 0.2 * g / 100.0 / 0.1, 1e-6);
}

TEST(Stretch, TheTermsSumToTheStrain) {
  TestSim sim = hanging_chain(5, 0.2, 100.0, 0.1);
  sim.system.strain_limit = 0.4;
  sim.state.position[3].x += 0.05;
  const StretchBreakdown stretch = explain_stretch(sim.system, sim.state, {}, all_springs(sim.system), always);
  ASSERT_TRUE(stretch.load && stretch.solver && stretch.limit && stretch.motion);
  EXPECT_NEAR(*stretch.load + *stretch.solver + *stretch.limit + *stretch.motion, stretch.now, 1e-12);
  // 5, 4 and 3 weights exceed the limit: strains 0.981, 0.785, 0.589, 0.392 and 0.196
  EXPECT_NEAR(*stretch.limit, -(0.581 + 0.3848 + 0.1886) / 5.0, 1e-4);
}

TEST(Stretch, AnUnconvergedSolverIsNamedAndAConvergedOneIsNot) {
  const TestSim sim = hanging_chain(30, 0.01, 1e4, 0.05);
  const auto solver = [&](const char* method, int substeps) {
    const StretchBreakdown stretch = explain_stretch(sim.system, sim.state, {.integrator = find_integrator(method), .substeps = substeps},
                                                     all_springs(sim.system), always);
    return std::abs(*stretch.solver / *stretch.load);
  };
  EXPECT_GT(solver("xpbd", 2), 0.5);
  EXPECT_LT(solver("xpbd", 200), 0.1 * solver("xpbd", 2));
  EXPECT_LT(solver("velocity_verlet", 40), 1e-3);
  EXPECT_LT(solver("implicit_euler", 2), 1e-3);
}

TEST(Stretch, TheStepErrorDecreasesWithTheSquareOfTheStep) {
  const TestSim sim = hanging_chain(3, 0.2, 100.0, 0.1);
  const auto error = [&](int substeps) {
    return *explain_stretch(sim.system, sim.state, {.substeps = substeps}, all_springs(sim.system), always).step_error;
  };
  const double ratio = error(4) / error(8);
  EXPECT_GT(ratio, 3.5);
  EXPECT_LT(ratio, 4.5);
}

TEST(Stretch, AReasonIsGivenWhereThereIsNoEquilibrium) {
  TestSim sim;
  const PointId a = sim.add(Vec3(0.0), 1.0), b = sim.add({1.0, 0.0, 0.0}, 1.0);
  sim.join(a, b, 10.0, 1.0, 0.0);
  const StretchBreakdown stretch = explain_stretch(sim.system, sim.state, {}, all_springs(sim.system), always);
  EXPECT_EQ(stretch.load, std::nullopt);
  EXPECT_EQ(stretch.why_no_load, "no point is nailed");
}

}  // namespace
}  // namespace hooke
