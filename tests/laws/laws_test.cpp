// Springs with a law against closed forms. Symbols: m mass, k stiffness, d damping, l0 rest length, g gravity, w = sqrt(k / m).
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/forces/forces.h"
#include "sim/methods/implicit/stiffness.h"
#include "sim/methods/rows.h"
#include "sim/statics/equilibrium.h"
#include "support/convergence.h"
#include "support/nets.h"

namespace hooke {
namespace {

using std::numbers::pi;
constexpr double g = 9.81;

void set_law(TestSim& sim, SpringId spring, const SpringLaw& law) { sim.system.spring(sim.system.index_of(spring))->law = law; }

SpringLaw law_of(SpringForce force, double k3 = 0.0) {
  SpringLaw law;
  law.force = force;
  law.k3 = k3;
  return law;
}

TEST(SpringLaw, ForceIsTheDerivativeOfTheEnergyAndStiffnessThatOfTheForce) {
  constexpr double k = 80.0, small = 1e-5;
  for (const SpringLaw& law : {law_of(SpringForce::Linear), law_of(SpringForce::Cable), law_of(SpringForce::Strut),
                               law_of(SpringForce::Cubic, 50.0), law_of(SpringForce::Cubic, -50.0)})
    for (const double e : {-0.9, -0.3, -0.01, 0.02, 0.4, 0.8}) {
      const SpringResponse here = response_of(law, k, e), after = response_of(law, k, e + small), before = response_of(law, k, e - small);
      EXPECT_NEAR(here.tension, (after.energy - before.energy) / (2.0 * small), 1e-6);
      EXPECT_NEAR(here.stiffness, (after.tension - before.tension) / (2.0 * small), 1e-6);
    }
}

TEST(SpringLaw, CablesOnlyPullAndStrutsOnlyPush) {
  EXPECT_EQ(response_of(law_of(SpringForce::Cable), 100.0, -0.1).tension, 0.0);
  EXPECT_EQ(response_of(law_of(SpringForce::Cable), 100.0, 0.1).tension, 10.0);
  EXPECT_EQ(response_of(law_of(SpringForce::Strut), 100.0, 0.1).tension, 0.0);
  EXPECT_EQ(response_of(law_of(SpringForce::Strut), 100.0, -0.1).tension, -10.0);
}

// k - 3 |k3| p^2 = 0: the force does not fall beyond, and does not turn into a repulsion
TEST(SpringLaw, ASofteningSpringKeepsItsLargestForce) {
  const SpringLaw law = law_of(SpringForce::Cubic, -100.0);
  const double p = std::sqrt(300.0 / 300.0);
  EXPECT_DOUBLE_EQ(response_of(law, 300.0, p).tension, 200.0 * p);
  EXPECT_DOUBLE_EQ(response_of(law, 300.0, 5.0 * p).tension, 200.0 * p);
  EXPECT_DOUBLE_EQ(response_of(law, 300.0, -5.0 * p).tension, -200.0 * p);
}

TEST(SpringLaw, ASofteningSpringNeverRepelsWhenLongNorAttractsWhenShort) {
  for (const double k3 : {-1e-3, -1e3, -1e12}) {
    double before = -std::numeric_limits<double>::infinity();
    for (double e = -1.0; e < 50.0; e += 0.125) {
      const double tension = response_of(law_of(SpringForce::Cubic, k3), 300.0, e).tension;
      EXPECT_GE(tension, before) << k3 << " " << e;
      EXPECT_GE(tension * e, 0.0) << k3 << " " << e;
      before = tension;
    }
  }
}

// ---- closed forms

// m g y = k/2 (y - l0)^2, y below the bridge; a spring that also pushes starts with k/2 l0^2: y = 2 (l0 + m g / k)
TEST(Bungee, TurnsWhereTheCordHasTheEnergyOfTheFall) {
  constexpr double m = 80.0, k = 200.0, l0 = 25.0, start = 1e-3, c = m * g / k;
  const auto turning_point = [&](bool is_cable) {
    TestSim sim;
    const PointId bridge = sim.nail(Vec3(0.0)), jumper = sim.add({0.0, -start, 0.0}, m);
    const SpringId cord = sim.join(bridge, jumper, k, l0);
    if (is_cable) set_law(sim, cord, law_of(SpringForce::Cable));
    double lowest = 0.0;
    for (int frame = 0; frame < 900; ++frame) {
      sim.run(velocity_verlet, 1.0 / 100.0, 20);
      lowest = std::max(lowest, -sim.position(jumper).y);
    }
    return lowest;
  };
  EXPECT_NEAR(turning_point(true), l0 + c + std::sqrt((l0 + c) * (l0 + c) - l0 * l0 - 2.0 * c * start), 1e-3);  // 43.472 m
  EXPECT_NEAR(turning_point(false), 2.0 * (l0 + c) - start, 1e-3);                                              // 57.847 m
}

// A mass falls from `height` above a strut of length l0 and stands on it for t = 2 (pi - atan(v w / g)) / w, v the speed at the contact.
struct StrutBounce {
  static constexpr double m = 0.5, k = 400.0, l0 = 0.6;
  TestSim sim;
  PointId mass;
  double period;
  explicit StrutBounce(double height) : mass(sim.add({0.0, l0 + height, 0.0}, m)) {
    set_law(sim, sim.join(sim.nail(Vec3(0.0)), mass, k, l0), law_of(SpringForce::Strut));
    const double w = std::sqrt(k / m), v = std::sqrt(2.0 * g * height);
    period = 2.0 * v / g + 2.0 * (pi - std::atan(v * w / g)) / w;
  }
  // Of a quarter after the second bounce, where the mass falls at g t; relative to how far.
  double error(const Integrator& method, int steps, double height) {
    const double seconds = 2.0 * period + 0.5 * std::sqrt(2.0 * height / g), t = seconds - 2.0 * period;
    sim.run(method, seconds, steps);
    return std::abs(sim.position(mass).y - (l0 + height - 0.5 * g * t * t));
  }
};

class Laws : public EveryMethod {
 protected:
  // The mean over impacts at many places within a step: one of them has no order.
  double mean_error(int steps) const {
    double sum = 0.0;
    constexpr int count = 40;
    for (int i = 0; i < count; ++i) {
      const double height = 0.2 + 0.002 * i;
      sum += StrutBounce(height).error(method(), steps, height) / count;
    }
    return sum;
  }
  void expect_order_of_change(const TestSim& start, double seconds, int steps, int order) const {
    const auto after = [&](int n) {
      TestSim sim = start;
      sim.run(method(), seconds, n);
      return sim.state;
    };
    const State coarse = after(steps), middle = after(2 * steps), fine = after(4 * steps);
    const auto distance = [](const State& a, const State& b) {
      double sum = 0.0;
      for (std::size_t i = 0; i < a.position.size(); ++i)
        sum += glm::dot(a.position[i] - b.position[i], a.position[i] - b.position[i]) +
               glm::dot(a.velocity[i] - b.velocity[i], a.velocity[i] - b.velocity[i]);
      return std::sqrt(sum);
    };
    const double order_found = std::log2(distance(coarse, middle) / distance(middle, fine));
    // between the asymptotic range of order 8 and round-off there is not much
    EXPECT_NEAR(order_found, order, order == 8 ? 0.85 : std::max(0.12, 0.03 * order))
        << distance(coarse, middle) << " " << distance(middle, fine);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Laws, testing::ValuesIn(every_method()), method_name);

// The force has a kink where a cable becomes taut and a strut is touched: the second order remains, and no more.
TEST_P(Laws, ThatAreNotSmoothLeaveTheSecondOrder) {
  const int order = std::min(method().order, 2), steps = order == 1 ? 16000 : 2000;
  const double coarse = mean_error(steps), fine = mean_error(4 * steps);
  EXPECT_NEAR(0.5 * std::log2(coarse / fine), order, 0.25) << coarse << " " << fine;
}

int steps_of(const Integrator& method) {
  if (method.stability == Stability::EachSpring) return 20000;
  return method.order == 1 ? 4000 : method.order == 2 ? 500 : method.order <= 4 ? 150 : 20;
}

// A chain of three masses on cubic springs, of which the last one softens.
TestSim cubic_chain(double damping) {
  TestSim sim;
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i <= 3; ++i) {
    const PointId next = sim.add({0.45 * i, 0.1 * i, 0.05 * i * i}, 0.3 + 0.1 * i, {0.3, -0.2, 0.1 * i});
    set_law(sim, sim.join(last, next, 60.0, 0.4, damping), law_of(SpringForce::Cubic, i < 3 ? 500.0 : -100.0));
    last = next;
  }
  return sim;
}
TEST_P(Laws, MeetsItsOrderOnCubicSprings) { expect_order_of_change(cubic_chain(0.0), 0.6, steps_of(method()), method().order); }
TEST_P(Laws, MeetsItsOrderOnDampedCubicSprings) {
  expect_order_of_change(cubic_chain(0.4), 0.6, steps_of(method()), method().order_with.damped);
}

// x'' = w^2 l0 a sin(W t) - w^2 x, from rest, at resonance: x = l0 a / 2 (sin(w t) - w t cos(w t))
TEST_P(Laws, DrivesAtTheResonanceOfAMuscle) {
  constexpr double m = 0.25, k = 9.0, l0 = 1.0, a = 0.1, w = 6.0, seconds = 2.2;
  const auto error = [&](int steps) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId mass = sim.add({l0, 0.0, 0.0}, m);
    SpringLaw law;
    law.amplitude = a;
    law.frequency = w / (2.0 * pi);
    set_law(sim, sim.join(sim.nail(Vec3(0.0)), mass, k, l0), law);
    sim.run(method(), seconds, steps);
    const double x = 0.5 * l0 * a * (std::sin(w * seconds) - w * seconds * std::cos(w * seconds));
    const double v = 0.5 * l0 * a * w * w * seconds * std::sin(w * seconds);
    return std::abs(sim.position(mass).x - l0 - x) + std::abs(sim.velocity(mass).x - v) / w;
  };
  const int order = method().order;
  // at most 1/16 of the period
  expect_order(error, order == 8 ? 44 : order == 4 ? 400 : 2 * asymptotic_steps(order), order);
}

// A winch shortens its cable at a constant rate: the weight on it bounces about where it would hang.
TEST_P(Laws, LiftsAWeightByAWinch) {
  constexpr double m = 2.0, k = 800.0, l0 = 1.0, rate = -0.1, w = 20.0, seconds = 1.3;
  const auto error = [&](int steps) {
    TestSim sim;
    const double hang = l0 + m * g / k;
    const PointId weight = sim.add({0.0, -hang, 0.0}, m);
    SpringLaw law = law_of(SpringForce::Cable);
    law.rate = rate;
    set_law(sim, sim.join(sim.nail(Vec3(0.0)), weight, k, l0), law);
    sim.run(method(), seconds, steps);
    return std::abs(-sim.position(weight).y - (hang + rate * seconds - rate / w * std::sin(w * seconds))) +
           std::abs(-sim.velocity(weight).y - rate * (1.0 - std::cos(w * seconds))) / w;
  };
  const int order = method().order;
  expect_order(error, order == 8 ? 40 : 4 * asymptotic_steps(order), order);
}

// x'' = -(k x + k3 x^3) / m, from rest at A: T = 4 K(n) / sqrt(k/m + k3 A^2/m), n = k3 A^2 / (2 (k + k3 A^2)), K by the mean of Gauss
TEST(Duffing, HasThePeriodOfTheEllipticIntegral) {
  constexpr double m = 0.7, k = 50.0, l0 = 2.0;
  for (const double k3 : {40.0, -10.0})
    for (const double amplitude : {0.1, 0.5, 1.0}) {
      const double stiffened = k + k3 * amplitude * amplitude, n = k3 * amplitude * amplitude / (2.0 * stiffened);
      double a = 1.0, b = std::sqrt(1.0 - n);
      while (std::abs(a - b) > 1e-15) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
      }
      const double period = 2.0 * pi / a / std::sqrt(stiffened / m);
      TestSim sim;
      sim.system.gravity = Vec3(0.0);
      const PointId mass = sim.add({l0 + amplitude, 0.0, 0.0}, m);
      set_law(sim, sim.join(sim.nail(Vec3(0.0)), mass, k, l0), law_of(SpringForce::Cubic, k3));
      sim.run(runge_kutta4, period, 4000);
      // it turns that much later
      const double late = sim.velocity(mass).x / (stiffened * amplitude / m);
      EXPECT_NEAR(late / period, 0.0, 1e-6) << "k3 " << k3 << " amplitude " << amplitude;
      EXPECT_NEAR(sim.position(mass).x, l0 + amplitude, 1e-6 * amplitude);
    }
}

// ---- statics and bounds

// Cables that start slack hang as springs do: all are taut in the end. Two that join the same nails stay slack.
TEST(Cables, OfASlackChainHangAsACatenary) {
  const auto hang = [](bool is_cable) {
    TestSim sim;
    constexpr int parts = 8;
    PointId last = sim.nail(Vec3(0.0));
    for (int i = 1; i <= parts; ++i) {
      const double x = 1.0 * i / parts;
      const PointId next = i < parts ? sim.add({x, -0.02 * i * (parts - i), 0.0}, 0.1) : sim.nail({x, 0.0, 0.0});
      const SpringId part = sim.join(last, next, 500.0, 0.2);
      if (is_cable) set_law(sim, part, law_of(SpringForce::Cable));
      last = next;
    }
    const Plan plan = make_plan(sim.system);
    Motion motion;
    pack(plan, sim.state, motion);
    StiffnessMatrix matrix(plan);
    const std::atomic<bool> stop = false;
    EXPECT_LT(find_equilibrium(plan, matrix, 1e-9, 1000, motion.x, stop), 1e-9);
    return motion.x;
  };
  const Field cables = hang(true), springs = hang(false);
  for (std::size_t i = 0; i < cables.size(); ++i) EXPECT_NEAR(cables[i], springs[i], 1e-9);
}

TEST(Bounds, OfCubicSpringsHoldToTwiceTheRestLength) {
  TestSim sim;
  const PointId mass = sim.add({1.0, 0.0, 0.0}, 2.0);
  set_law(sim, sim.join(sim.nail(Vec3(0.0)), mass, 100.0, 0.5), law_of(SpringForce::Cubic, 200.0));
  EXPECT_DOUBLE_EQ(bound_spectrum(sim.system).omega, std::sqrt((100.0 + 3.0 * 200.0 * 0.25) / 2.0));
  EXPECT_DOUBLE_EQ(response_of(*sim.system.springs()[0].law, 100.0, 0.5).stiffness, 100.0 + 3.0 * 200.0 * 0.25);
}

// ---- identities

// Internal forces: whatever the laws, linear momentum changes by gravity alone.
TEST_P(Laws, ConserveMomentum) {
  TestSim sim = net(4, 1e2, 0.05);
  for (Index s = 0; s < sim.system.spring_count(); ++s) {
    SpringLaw law = law_of(static_cast<SpringForce>(s % 4), s % 4 == 3 ? 30.0 : 0.0);
    law.amplitude = s % 3 == 0 ? 0.2 : 0.0;
    sim.system.spring(s)->law = law;
  }
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = false;
  const auto momentum = [&] {
    Vec3 sum(0.0);
    for (Index i = 0; i < sim.system.point_count(); ++i) sum += sim.system.points()[i].mass * sim.state.velocity[i];
    return sum;
  };
  const Vec3 before = momentum();
  sim.run(method(), 0.2, 200);
  const Vec3 change = momentum() - before;  // the whole mass is 1 kg
  EXPECT_NEAR(change.x, 0.0, 1e-10);
  EXPECT_NEAR(change.y, -9.81 * 0.2, 1e-10);
  EXPECT_NEAR(change.z, 0.0, 1e-10);
}

}  // namespace
}  // namespace hooke
