// Forecasts against closed forms and against simulation. Symbols: m mass, k stiffness, d damping, c drag.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "study/forecast.h"
#include "support/nets.h"

namespace hooke {
namespace {

constexpr double g = 9.81, pi = std::numbers::pi;

Forecast forecast_of(const TestSim& sim) { return make_forecast(std::make_shared<const System>(sim.system), sim.state, {}, false); }

// The scene after it has come to rest under strong drag.
TestSim at_rest(TestSim sim) {
  sim.system.drag = 5.0;
  sim.run(*find_integrator("baraff_witkin"), 60.0, 1200);
  return sim;
}

TEST(Forecast, AHangingMassSagsByItsWeightOverItsStiffness) {
  const double m = 0.7, k = 120.0, l0 = 0.5, d = 3.0, c = 0.4;
  TestSim sim;
  const PointId nail = sim.nail(Vec3(0.0)), mass = sim.add({0.0, -l0, 0.0}, m);
  sim.join(nail, mass, k, l0, d);
  sim.system.drag = c;
  const Forecast forecast = forecast_of(sim);
  ASSERT_TRUE(forecast.sag && forecast.slowest && forecast.fastest);
  EXPECT_NEAR(*forecast.sag, m * g / k, 1e-8);

  // vertical: zeta = d / (2 sqrt(k m)) and c / (2 omega)
  const double omega = std::sqrt(k / m);
  EXPECT_NEAR(forecast.fastest->omega, omega, 1e-9 * omega);
  EXPECT_NEAR(dashpot_ratio(*forecast.fastest), d / (2.0 * std::sqrt(k * m)), 1e-9);
  EXPECT_NEAR(drag_ratio(*forecast.fastest, forecast.drag), c / (2.0 * omega), 1e-9);

  // horizontal, as a pendulum, which the dashpot does not damp
  EXPECT_NEAR(forecast.slowest->omega, std::sqrt(g / (l0 + m * g / k)), 1e-6);
  EXPECT_NEAR(dashpot_ratio(*forecast.slowest), 0.0, 1e-9);
}

// Drawn horizontally and nailed at one end: it first has to swing down.
TEST(Forecast, ARopeDrawnHorizontallyHangsAndSwingsLikeARope) {
  constexpr int n = 40;
  const double length = 1.0, mass = 0.1, k = 2000.0;
  TestSim sim;
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i <= n; ++i) {
    const PointId next = sim.add({length * i / n, 0.0, 0.0}, mass / n);
    sim.join(last, next, k, length / n);
    last = next;
  }
  const Forecast forecast = forecast_of(sim);
  ASSERT_TRUE(forecast.sag && forecast.slowest);
  // the r-th spring from the bottom carries r masses
  EXPECT_NEAR(*forecast.sag, mass / n * g / k * n * (n + 1) / 2.0, 1e-6);
  // J0(2 omega sqrt(L / g)) = 0 of the continuous rope (Daniel Bernoulli 1733); the difference converges as 1 / n
  const double continuous = 0.5 * 2.404825557695773 * std::sqrt(g / length);
  EXPECT_NEAR(forecast.slowest->omega, continuous, 0.02 * continuous);
}

TEST(Forecast, AChainBetweenNailsHasItsModesAndUnconnectedPointsHaveNone) {
  // omega_j = 2 sqrt(k / m) sin(j pi / (2 (N + 1))) along the chain; transversely there is no restoring force
  constexpr int n = 12;
  const double m = 0.3, k = 500.0, l0 = 0.1, d = 0.2;
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i <= n + 1; ++i) {
    const Vec3 place(l0 * i, 0.0, 0.0);
    const PointId next = i == n + 1 ? sim.nail(place) : sim.add(place, m);
    sim.join(last, next, k, l0, d);
    last = next;
  }
  const Forecast forecast = forecast_of(sim);
  EXPECT_FALSE(forecast.sag);
  ASSERT_TRUE(forecast.slowest && forecast.fastest);
  const auto omega = [&](int j) { return 2.0 * std::sqrt(k / m) * std::sin(j * pi / (2.0 * (n + 1))); };
  EXPECT_NEAR(forecast.slowest->omega, omega(1), 1e-6 * omega(1));
  EXPECT_NEAR(forecast.fastest->omega, omega(n), 1e-6 * omega(n));
  EXPECT_NEAR(dashpot_ratio(*forecast.slowest), d * omega(1) / (2.0 * k), 1e-6);
  EXPECT_NEAR(dashpot_ratio(*forecast.fastest), d * omega(n) / (2.0 * k), 1e-6);
}

// Drawn crooked, it is found at rest except for a small residual tension, in which it would swing extremely slowly.
TEST(Forecast, ResidualTensionAtRestIsNotReportedAsAMode) {
  constexpr int n = 12;
  const double m = 0.3, k = 500.0, l0 = 0.1;
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i <= n + 1; ++i) {
    const Vec3 place(l0 * i, 0.0, 0.0), crooked(0.01 * std::sin(i), 0.01 * std::cos(3.0 * i), 0.01 * std::sin(2.0 * i));
    const PointId next = i == n + 1 ? sim.nail(place) : sim.add(place + crooked, m);
    sim.join(last, next, k, l0);
    last = next;
  }
  const Forecast forecast = forecast_of(sim);
  ASSERT_TRUE(forecast.slowest);
  const double omega = 2.0 * std::sqrt(k / m) * std::sin(pi / (2.0 * (n + 1)));
  EXPECT_NEAR(forecast.slowest->omega, omega, 1e-3 * omega);
}

TEST(Forecast, AFreeFallingBodyVibratesAsIfWeightlessAndDoesNotSag) {
  const double m = 2.0, k = 50.0;
  TestSim sim;
  const PointId a = sim.add({0.0, 0.0, 0.0}, m), b = sim.add({0.4, 0.3, 0.0}, m);
  sim.join(a, b, k, 0.5);
  const Forecast forecast = forecast_of(sim);
  EXPECT_FALSE(forecast.sag);
  ASSERT_TRUE(forecast.slowest && forecast.fastest);
  EXPECT_NEAR(forecast.slowest->omega, std::sqrt(2.0 * k / m), 1e-6);
  EXPECT_NEAR(forecast.fastest->omega, std::sqrt(2.0 * k / m), 1e-6);
  EXPECT_EQ(forecast.why_no_sag, "no point is nailed");
  // a nail that nothing hangs on
  sim.nail({1.0, 0.0, 0.0});
  EXPECT_EQ(forecast_of(sim).why_no_sag, "a part hangs on no nail");
}

TEST(Forecast, ModesOfEqualFrequencyAndDifferentDampingHaveNoSingleDampingRatio) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  for (int i = 0; i < 3; ++i) {
    const double x = 0.5 * i;
    const PointId nail = sim.nail({x, 0.0, 0.0}), mass = sim.add({x, -0.5, 0.0});
    sim.join(nail, mass, 40.0, 0.5, 2.0 * i);
  }
  const Forecast forecast = forecast_of(sim);
  ASSERT_TRUE(forecast.slowest && forecast.fastest);
  EXPECT_NEAR(forecast.slowest->omega, std::sqrt(40.0), 1e-6);
  EXPECT_TRUE(std::isnan(dashpot_ratio(*forecast.slowest)));
  EXPECT_TRUE(std::isnan(dashpot_ratio(*forecast.fastest)));
  // with equal damping there is one
  for (Index s = 0; s < 3; ++s) sim.system.spring(s)->damping = 3.0;
  EXPECT_NEAR(dashpot_ratio(forecast_of(sim).slowest.value_or(Mode{})), 3.0 / (2.0 * std::sqrt(40.0)), 1e-6);
}

// A membrane carries its weight only by deflecting, so its sag is nonlinear.
TEST(Forecast, ADrumSagsToItsRestPosition) {
  constexpr int n = 12;
  TestSim sim = cloth(n);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      sim.system.point(sheet::at(n, row, column)).nailed = row % (n - 1) == 0 || column % (n - 1) == 0;
  const Forecast forecast = forecast_of(sim);
  ASSERT_TRUE(forecast.sag);
  double deepest = 0.0;
  for (const Vec3& x : at_rest(sim).state.position) deepest = std::min(deepest, x.z);
  EXPECT_NEAR(*forecast.sag, -deepest, -0.02 * deepest);
}

// From horizontal it swings down and folds; its sag is the stretch due to its weight, not the distance it swings down.
TEST(Forecast, AClothHeldAtTwoCornersSagsByTheStretchDueToItsWeight) {
  TestSim sim = cloth(12);
  const Forecast forecast = forecast_of(sim);
  ASSERT_TRUE(forecast.sag && forecast.slowest && forecast.fastest);
  EXPECT_GT(*forecast.sag, 1e-4);
  EXPECT_LT(*forecast.sag, 0.05);
  EXPECT_GT(forecast.slowest->omega, 1.0);
  EXPECT_LT(forecast.slowest->omega, 10.0);
  const double bound = make_plan(sim.system).spectrum.omega;
  EXPECT_LT(forecast.fastest->omega, bound);
  EXPECT_GT(forecast.fastest->omega, 0.5 * bound);

  // starting from there at twice the stiffness, it sags about half as far
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->stiffness *= 2.0;
  const Forecast stiffer = make_forecast(std::make_shared<const System>(sim.system), sim.state, forecast, false);
  ASSERT_TRUE(stiffer.sag);
  EXPECT_NEAR(*stiffer.sag / *forecast.sag, 0.5, 0.1);
}

// A vertical sheet of k = 200 N/m, diagonals 100, 1 kg distributed equally over the points, held at its top row; sags measured with a
// different program.
TEST(Forecast, AVerticalSheetSagsAsMeasured) {
  const auto sag = [](int n) {
    TestSim sim;
    const double a = 1.0 / (n - 1);
    for (Index i = 0; i < n * n; ++i) {
      const Index row = i / n, column = i % n;
      sim.add({a * column, -a * row, 0.0}, 1.0 / (n * n));
      sim.system.point(i).nailed = i < n;
    }
    sheet::join_neighbors(sim, n, 200.0, 100.0, 0.0);
    return forecast_of(sim).sag.value_or(0.0);
  };
  EXPECT_NEAR(sag(5), 0.0149, 0.0005);
  EXPECT_NEAR(sag(9), 0.0164, 0.0005);
  EXPECT_NEAR(sag(17), 0.0172, 0.0005);
}

TEST(Forecast, IsAbsentWhereItDoesNotApply) {
  TestSim sim;
  const auto is_absent = [&] {
    const Forecast forecast = forecast_of(sim);
    return !forecast.sag && !forecast.slowest;
  };
  EXPECT_TRUE(is_absent());
  const PointId nail = sim.nail(Vec3(0.0)), mass = sim.add({0.0, -1.0, 0.0});
  EXPECT_TRUE(is_absent());
  sim.join(nail, mass, 0.0, 1.0);
  EXPECT_TRUE(is_absent());
  sim.system.spring(0)->stiffness = 100.0;
  EXPECT_FALSE(is_absent());

  // it would tear or lie on the ground, or one part falls while the other hangs
  sim.system.break_strain = 0.05;
  EXPECT_TRUE(is_absent());
  sim.system.break_strain = 0.2;
  EXPECT_FALSE(is_absent());
  sim.system.colliders = {{.shape = Plane{{0.0, -1.05, 0.0}, {0.0, 1.0, 0.0}}}};
  EXPECT_TRUE(is_absent());
  sim.system.colliders.clear();
  sim.add({1.0, 0.0, 0.0});
  EXPECT_TRUE(is_absent());
}

TEST(Forecast, CanBeCanceled) {
  const TestSim sim = cloth(32);
  const Forecast forecast = make_forecast(std::make_shared<const System>(sim.system), sim.state, {}, true);
  EXPECT_FALSE(forecast.sag || forecast.slowest || forecast.fastest);
}

}  // namespace
}  // namespace hooke
