// Coupled and driven oscillators: the spring pendulum, and a mass attached to a shaken support. Symbols: m mass, k stiffness, d damping, c
// drag rate, l0 rest length, g gravity.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/forces/energy/energy.h"
#include "support/convergence.h"
#include "support/fall.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

using std::numbers::pi;

// A mass on a spring that hangs from a nail, displaced horizontally by `x` and downwards by `z` from its rest position at l = l0 + m g / k.
struct Pendulum {
  TestSim sim;
  PointId mass;
  double length;
  Pendulum(double m, double k, double l0, double x, double z) : mass(sim.add({x, -l0 - m * g / k - z, 0.0}, m)), length(l0 + m * g / k) {
    sim.join(sim.nail(Vec3(0.0)), mass, k, l0);
  }
  double horizontal_position() const { return sim.position(mass).x; }
  double below() const { return -sim.position(mass).y - length; }
};

class SpringPendulum : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, SpringPendulum, testing::ValuesIn(every_method()), method_name);

// z cos(sqrt(k / m) t), at any amplitude
TEST_P(SpringPendulum, BouncesAtTheFrequencyOfItsStiffness) {
  const double m = 0.4, k = 90.0, w = std::sqrt(k / m), seconds = 2.3 / w;
  const auto error = [&](int steps) {
    Pendulum pendulum(m, k, 0.5, 0.0, 0.2);
    pendulum.sim.run(method(), seconds, steps);
    EXPECT_EQ(pendulum.horizontal_position(), 0.0);
    return std::abs(pendulum.below() - 0.2 * std::cos(w * seconds));
  };
  expect_order(error, asymptotic_steps(method().order), method().order);
}

// x cos(sqrt(g / l) t) for small x: the coupling lifts the mass by x^2 / l, which changes x by (x / l)^2 = 1e-12 of itself
TEST_P(SpringPendulum, SwingsAtTheFrequencyOfItsLength) {
  const double m = 0.4, k = 90.0, x = 1e-6;
  const auto error = [&](int steps) {
    Pendulum pendulum(m, k, 0.5, x, 0.0);
    const double w = std::sqrt(g / pendulum.length), seconds = 2.3 / w;
    pendulum.sim.run(method(), seconds, steps);
    return std::abs(pendulum.horizontal_position() / x - std::cos(w * seconds));
  };
  // positions have a resolution of 1e-10 relative to x
  if (method().order <= 2) {
    expect_order(error, asymptotic_steps(method().order), method().order);
  } else {
    EXPECT_LT(error(asymptotic_steps(method().order) * 4), 2e-9);
  }
}

// sqrt(k / m) = 2 sqrt(g / l): bouncing excites swinging until all energy is transferred, and then back. At a ratio of three there is no
// transfer.
TEST(SpringPendulum, ExchangesEnergyOnlyAtTheTwoToOneResonance) {
  for (const double ratio : {2.0, 3.0}) {
    // l = l0 + m g / k with k / m = ratio^2 g / l: m g / k = l / ratio^2
    const double m = 0.4, l = 1.0, k = m * ratio * ratio * g / l;
    Pendulum pendulum(m, k, l - l / (ratio * ratio), 1e-3, 0.08);
    const double start = compute_energy(pendulum.sim.system, pendulum.sim.state).total();
    double widest = 0.0, min_bounce = 1.0;
    for (int i = 0; i < 600; ++i) {
      pendulum.sim.run(*find_integrator("blanes_moan4"), 0.1, 20);
      const Vec3 v = pendulum.sim.velocity(pendulum.mass);
      // the amplitudes that correspond to position and velocity
      widest = std::max(widest, std::hypot(pendulum.horizontal_position(), v.x / std::sqrt(g / l)));
      min_bounce = std::min(min_bounce, std::hypot(pendulum.below(), v.y / std::sqrt(k / m)));
    }
    EXPECT_NEAR(compute_energy(pendulum.sim.system, pendulum.sim.state).total(), start, 1e-9) << "ratio " << ratio;
    if (ratio == 2.0) {
      // m w^2 X^2 / 2 = m (2 w)^2 Z^2 / 2: the swing is twice as wide as the bounce was high, to first order in the amplitudes
      EXPECT_NEAR(widest, 2.0 * 0.08, 0.1 * 0.16);
      EXPECT_LT(min_bounce, 0.25 * 0.08);
    } else {
      EXPECT_LT(widest, 2e-3);
      EXPECT_GT(min_bounce, 0.9 * 0.08);
    }
  }
}

// A mass on a spring whose other end is held by a hand that follows A sin(W t) along straight segments of a fortieth of a period: this
// equals A sin(W t) times (sin(s) / s)^2, s = W dt / 2, plus harmonics from the 39th up, which contribute 1e-5 of the motion of the mass.
class Shaken : public EveryMethod {
 protected:
  static constexpr double m = 0.5, w0 = 10.0, zeta = 0.2, hand_amplitude = 0.01;

  // the steady-state amplitude divided by A, after transients have decayed to 1e-12
  double gain(double r, double d, double c, int substeps) const {
    constexpr int frames = 40;
    const double period = 2.0 * pi / (r * w0), dt = period / frames, s = pi / frames;
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    sim.system.drag = c;
    const PointId held = sim.add(Vec3(0.0)), mass = sim.add({1.0, 0.0, 0.0}, m);
    sim.join(held, mass, m * w0 * w0, 1.0, d);
    sim.system.grab = Grab{.point = held, .kind = GrabKind::Hold};
    const int periods = static_cast<int>(std::log(1e12) / (zeta * w0) / period) + 2;
    std::complex<double> sum = 0.0;
    for (int i = 1; i <= periods * frames; ++i) {
      sim.state.hand.target = {hand_amplitude * std::sin(2.0 * pi * i / frames), 0.0, 0.0};
      sim.run(method(), dt, substeps);
      if (i > (periods - 1) * frames) sum += (sim.position(mass).x - 1.0) * std::polar(2.0 / frames, -2.0 * pi * i / frames);
    }
    return std::abs(sum) / hand_amplitude / std::pow(std::sin(s) / s, 2);
  }

  // A method of order p has an error of (h w0)^p in frequency or damping, hence of at most 1 / (2 zeta) times that in the gain, plus a
  // tenth for terms of the next order.
  void expect_gain(double r, double d, double c, double expected) const {
    const int substeps = method().order == 1 ? 40 : 10;
    const double hw = 2.0 * pi / r / (40.0 * substeps);
    EXPECT_NEAR(gain(r, d, c, substeps) / expected, 1.0, std::max(2e-5, 1.1 * std::pow(hw, method().order) / (2.0 * zeta))) << "r = " << r;
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Shaken, testing::ValuesIn(every_method()), method_name);

// 1 / sqrt((1 - r^2)^2 + (2 zeta r)^2), r = W / w0, drag c = 2 zeta w0
TEST_P(Shaken, WithDragFollowsTheResonanceCurve) {
  for (const double r : {0.5, 1.0, 2.0}) expect_gain(r, 0.0, 2.0 * zeta * w0, 1.0 / std::hypot(1.0 - r * r, 2.0 * zeta * r));
}

// a dashpot to the shaken end also drives the mass: sqrt(1 + (2 zeta r)^2) times as much, d = 2 zeta w0 m
TEST_P(Shaken, ThroughADashpotFollowsTheResonanceCurve) {
  for (const double r : {0.5, 1.0, 2.0})
    expect_gain(r, 2.0 * zeta * w0 * m, 0.0, std::hypot(1.0, 2.0 * zeta * r) / std::hypot(1.0 - r * r, 2.0 * zeta * r));
}

}  // namespace
}  // namespace hooke
