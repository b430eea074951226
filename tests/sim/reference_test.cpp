// Three scenes against converged positions: a drum, a rope and a cloth of 32 and 64 points, computed once with Runge-Kutta 4 at 1e-5 s, at
// half that step, and in long double; nine decimals are certain.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "support/convergence.h"
#include "support/nets.h"

namespace hooke {
namespace {

constexpr double certain = 1e-9;

TestSim drum(int n) {
  TestSim sim = cloth(n);
  for (int i = 0; i < n * n; ++i) {
    const int row = i / n, column = i % n;
    sim.system.point(i).nailed = row == 0 || column == 0 || row == n - 1 || column == n - 1;
  }
  return sim;
}

// x = i / 63, 0.1 kg, k = 1e4 N/m, held at one end and released horizontally
TestSim rope(int n) {
  TestSim sim;
  sim.system.gravity = {0.0, 0.0, -9.81};
  for (int i = 0; i < n; ++i) sim.add({static_cast<double>(i) / (n - 1), 0.0, 0.0}, 0.1 / n);
  sim.system.point(0).nailed = true;
  for (int i = 1; i < n; ++i) sim.join(sim.system.points()[i - 1].id, sim.system.points()[i].id, 1e4, 1.0 / (n - 1));
  return sim;
}

Vec3 mean(const State& state) {
  Vec3 sum(0.0);
  for (const Vec3& x : state.position) sum += x;
  return sum / static_cast<double>(state.position.size());
}

State after(const TestSim& start, const char* method, double seconds, double hertz) {
  TestSim sim = start;
  sim.run(*find_integrator(method), seconds, static_cast<int>(std::lround(seconds * hertz)));
  return sim.state;
}

// The Richardson extrapolation from two runs, at steps of 1 / hertz and half that; its error is far smaller than that of either run.
Vec3 extrapolated(const Vec3& coarse, const Vec3& fine, int order) { return fine + (fine - coarse) / (std::exp2(order) - 1.0); }

TEST(Reference, DrumConvergesWithRungeKutta) {
  const Vec3 expected(0.516139452, -0.516139452, -0.014719998);
  const State coarse = after(drum(32), "runge_kutta4", 0.25, 6000.0), fine = after(drum(32), "runge_kutta4", 0.25, 12000.0);
  EXPECT_LT(glm::distance(fine.position[528], expected), glm::distance(coarse.position[528], expected) / 8.0 + certain);
  EXPECT_LT(glm::distance(extrapolated(coarse.position[528], fine.position[528], 4), expected), 2.0 * certain);
}

TEST(Reference, DrumConvergesWithVerlet) {
  const State coarse = after(drum(32), "velocity_verlet", 1.0, 8000.0), fine = after(drum(32), "velocity_verlet", 1.0, 16000.0);
  const Vec3 expected(0.516165695, -0.516165695, -0.000460663), expected_mean(0.5, -0.5, -0.008713565);
  EXPECT_LT(glm::distance(fine.position[528], expected), glm::distance(coarse.position[528], expected) / 3.5 + certain);
  EXPECT_LT(glm::distance(mean(fine), expected_mean), glm::distance(mean(coarse), expected_mean) / 3.5 + certain);
  EXPECT_LT(glm::distance(extrapolated(coarse.position[528], fine.position[528], 2), expected), 1e-7);
  EXPECT_LT(glm::distance(extrapolated(mean(coarse), mean(fine), 2), expected_mean), 1e-8);

  const Vec3 halfway(0.516211063, -0.516211063, -0.049190882);
  EXPECT_LT(glm::distance(after(drum(32), "velocity_verlet", 0.5, 16000.0).position[528], halfway), 1e-6);
}

TEST(Reference, RopeConverges) {
  const Vec3 quarter(0.881716351, 0.0, -0.306562500), half(-0.220203585, 0.0, -0.878862949), half_mean(-0.033742254, 0.0, -0.493959576);
  for (const auto& [method, order, hertz] : {std::tuple{"runge_kutta4", 4, 40000.0}, {"velocity_verlet", 2, 80000.0}}) {
    const State coarse = after(rope(64), method, 0.25, hertz), fine = after(rope(64), method, 0.25, 2.0 * hertz);
    const double min = std::exp2(order) * 0.8;
    EXPECT_LT(glm::distance(fine.position[63], quarter), glm::distance(coarse.position[63], quarter) / min + certain) << method;
    EXPECT_LT(glm::distance(extrapolated(coarse.position[63], fine.position[63], order), quarter), 2.0 * certain) << method;
  }
  const State coarse = after(rope(64), "runge_kutta4", 0.5, 40000.0), fine = after(rope(64), "runge_kutta4", 0.5, 80000.0);
  EXPECT_LT(glm::distance(extrapolated(coarse.position[63], fine.position[63], 4), half), 2.0 * certain);
  EXPECT_LT(glm::distance(extrapolated(mean(coarse), mean(fine), 4), half_mean), 2.0 * certain);
}

// the cloth buckles beside its nails and errors double 60 times per second: one point is compared up to 0.25 s, the mean up to 0.5 s
TEST(Reference, ClothConverges) {
  const Vec3 expected(0.516137244, -0.403723769, -0.305391510), expected_mean(0.5, 0.030099848, -0.497170732);
  const State coarse = after(cloth(32), "runge_kutta4", 0.25, 6000.0), fine = after(cloth(32), "runge_kutta4", 0.25, 12000.0);
  EXPECT_LT(glm::distance(fine.position[528], expected), glm::distance(coarse.position[528], expected) / 8.0 + certain);
  EXPECT_LT(glm::distance(fine.position[528], expected), 1e-7);
  EXPECT_LT(glm::distance(mean(after(cloth(32), "runge_kutta4", 0.5, 8000.0)), expected_mean), 1e-6);
}

}  // namespace
}  // namespace hooke
