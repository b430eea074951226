// Planes that hold points until a force pulls them off.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/forces/terms/rows.h"
#include "sim/methods/rows.h"
#include "support/convergence.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

class StickyPlanes : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, StickyPlanes, testing::ValuesIn(every_method()), method_name);

// A mass on a sticky floor without gravity, and another above it on a spring, which oscillates with the speed `speed` and pulls the first
// off.
struct PulledOff {
  static constexpr double stiffness = 40.0, mass = 1.0, other_mass = 0.5, length = 0.5, speed = 1.5;
  double strength = 5.0;

  TestSim sim(double damping = 0.0) const {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId first = sim.add({0.0, 0.0, 0.0}, mass), second = sim.add({0.0, length, 0.0}, other_mass, {0.0, speed, 0.0});
    sim.join(first, second, stiffness, length, damping);
    sim.system.colliders = {{.shape = Plane{}}};
    sim.system.forces = {{.term = &sticky_force, .values = {strength}}};
    return sim;
  }
  // [m], of both after `seconds`. The first is held until k (v / w) sin(w t) = strength; then their center moves straight, and their
  // distance oscillates.
  std::pair<double, double> heights(double seconds) const {
    const double omega = std::sqrt(stiffness / other_mass), release = std::asin(strength * omega / (stiffness * speed)) / omega;
    const double stretch = strength / stiffness, rate = speed * std::cos(omega * release), t = seconds - release;
    const double total = mass + other_mass, reduced = std::sqrt(stiffness * total / (mass * other_mass));
    const double center = other_mass / total * (length + stretch + rate * t);
    const double distance = length + stretch * std::cos(reduced * t) + rate / reduced * std::sin(reduced * t);
    return {center - other_mass / total * distance, center + mass / total * distance};
  }
  // [m], the sum over both.
  double error(const TestSim& sim, double seconds) const {
    const auto [first, second] = heights(seconds);
    return std::abs(sim.state.position[0].y - first) + std::abs(sim.state.position[1].y - second);
  }
};

// It is released at the end of the substep in which the pull exceeds the strength: the mean over several numbers of steps, because the
// error depends on its place within a step.
TEST_P(StickyPlanes, LetGoWithinASubstep) {
  constexpr double seconds = 0.25;
  const auto mean_error = [&](int steps) {
    double sum = 0.0;
    for (int i = 0; i < 8; ++i) {
      TestSim sim = PulledOff{}.sim();
      sim.run(method(), seconds, steps + i * steps / 16);
      sum += PulledOff{}.error(sim, seconds);
    }
    return sum / 8.0;
  };
  const double coarse = mean_error(200), fine = mean_error(800);
  EXPECT_LT(fine, 0.4 * coarse);
  EXPECT_LT(fine, 2e-3);
}

// Whether dashpots are split off or not. A release that is late by a step of 1 ms changes a velocity by 5 mm/s.
TEST_P(StickyPlanes, DashpotsPullAsSpringsDo) {
  constexpr double seconds = 0.3;
  TestSim fine = PulledOff{}.sim(2.0);
  fine.run(runge_kutta4, seconds, 600);
  TestSim sim = PulledOff{}.sim(2.0);
  sim.run(method(), seconds, method().order == 1 ? 3000 : 300);
  constexpr double tolerance = 2e-3;
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(sim.state.position[i].y, fine.state.position[i].y, tolerance) << "point " << i;
}

// m A w^2 sin(w t) = strength; a release that is late by a step of 0.5 ms changes the velocity by 1 mm/s.
TEST_P(StickyPlanes, APlaneThatOscillatesLetsGoWhenItsAccelerationDemandsMore) {
  constexpr double amplitude = 0.02, frequency = 2.0, strength = 2.0, seconds = 0.3;
  const double omega = 2.0 * std::numbers::pi * frequency;
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.add({0.0, 0.0, 0.0}, 1.0, {0.0, amplitude * omega, 0.0});
  sim.system.colliders = {{.shape = Plane{}, .path = {.amplitude = {0.0, amplitude, 0.0}, .frequency = frequency}}};
  sim.system.forces = {{.term = &sticky_force, .values = {strength}}};
  sim.run(method(), seconds, 600);
  const double release = std::asin(strength / (amplitude * omega * omega)) / omega;
  const double expected = amplitude * (std::sin(omega * release) + omega * (seconds - release) * std::cos(omega * release));
  EXPECT_NEAR(sim.state.position[0].y, expected, 3e-4);
}

// dop853 takes the rest of a step in shorter ones.
TEST_P(StickyPlanes, ACeilingHoldsWhatIsThrownAtItAndNotWhatReboundsOrIsTooHeavy) {
  if (&method() == &dop853) return;
  for (const auto& [strength, restitution, is_held] :
       {std::tuple(12.0, 0.0, true), std::tuple(12.0, 0.5, false), std::tuple(8.0, 0.0, false)})
    for (const int steps : {7, 700}) {
      TestSim sim;
      sim.add({0.0, -0.3, 0.0}, 1.0, {0.5, 4.0, 0.0});
      sim.system.colliders = {{.shape = Plane{.normal = {0.0, -1.0, 0.0}}, .restitution = restitution}};
      sim.system.forces = {{.term = &sticky_force, .values = {strength}}};
      sim.run(method(), 0.4, steps);
      EXPECT_EQ(sim.state.position[0].y > -1e-9, is_held) << strength << " N, " << steps << " steps";
    }
}

}  // namespace
}  // namespace hooke
