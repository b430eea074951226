// Conserved quantities, and the energy lost to dashpots and drag.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "sim/forces/energy/energy.h"
#include "support/convergence.h"
#include "support/nets.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// A free network of 20 points, without nails or gravity.
TestSim free_network(double max_damping) {
  TestSim sim = random_sim(3, 20, 60, 3, max_damping);
  sim.system.gravity = Vec3(0.0);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = false;
  return sim;
}

double momentum_scale(const TestSim& sim) {
  double scale = 0.0;
  for (Index i = 0; i < sim.system.point_count(); ++i)
    scale += sim.system.points()[i].mass * (1.0 + glm::length(sim.state.velocity[i])) * (1.0 + glm::length(sim.state.position[i]));
  return scale;
}

class Conservation : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Conservation, testing::ValuesIn(every_method()), method_name);

TEST_P(Conservation, OfMomentumToRoundOff) {
  for (const double damping : {0.0, 2.0}) {
    TestSim sim = free_network(damping);
    const Momentum before = compute_momentum(sim.system, sim.state);
    sim.run(method(), 1.0, 2000);
    const Momentum after = compute_momentum(sim.system, sim.state);
    EXPECT_LT(glm::distance(after.linear, before.linear), 1e-13 * momentum_scale(sim)) << "d up to " << damping;
  }
}

// Symplectic methods apply kicks along the springs and drifts along v. The other methods evaluate forces at positions other than those of
// the points, and XPBD does so with its corrections, so their error in angular momentum is of the order of their accuracy.
TEST_P(Conservation, OfAngularMomentumToRoundOffOnlyIfSymplectic) {
  for (const double damping : {0.0, 2.0}) {
    TestSim sim = free_network(damping);
    const Momentum before = compute_momentum(sim.system, sim.state);
    const auto [seconds, steps] = method().is_symplectic() ? std::pair(1.0, 2000) : std::pair(0.2, 20);
    sim.run(method(), seconds, steps);
    const double lost = glm::distance(compute_momentum(sim.system, sim.state).angular, before.angular);
    if (method().is_symplectic()) {
      EXPECT_LT(lost, 1e-13 * momentum_scale(sim)) << "d up to " << damping;
    } else {
      EXPECT_GT(lost, 1e-9 * momentum_scale(sim)) << "d up to " << damping;
    }
  }
}

// Sixteen seconds of the swinging net, which is dozens of its periods. If the energy drifts steadily, its mean changes from the first half
// to the second by about its spread within the first half, or by half of that if it decays; if the energy is bounded, its mean hardly
// changes.
TEST_P(Conservation, OfEnergyIsAsDeclared) {
  TestSim sim = net(8, 1e2, 0.0);
  const double omega = make_plan(sim.system).spectrum.omega;
  const auto steps_per_frame = [&] {
    switch (method().stability) {
      case Stability::None:
        return static_cast<int>(0.05 * omega * omega);  // modes grow by e^(t h w^2 / 2): at most e^16
      case Stability::Conditional:
      case Stability::EachSpring:
        return static_cast<int>(0.1 * omega);  // one radian per step
      case Stability::Adaptive:
        return static_cast<int>(0.025 * omega);
      default:
        return 6;
    }
  };
  constexpr int frames = 160;
  std::vector<double> energy;
  for (int frame = 0; frame < frames; ++frame) {
    sim.run(method(), 0.1, steps_per_frame());
    energy.push_back(compute_energy(sim.system, sim.state).total());
  }

  const int half_frames = frames / 2;
  const auto half = energy.begin() + half_frames;
  const double first = std::accumulate(energy.begin(), half, 0.0) / half_frames,
               second = std::accumulate(half, energy.end(), 0.0) / half_frames;
  const double spread = *std::max_element(energy.begin(), half) - *std::min_element(energy.begin(), half);
  EXPECT_GT(spread, 1e-13);
  switch (method().energy) {
    case EnergyTrend::Grows:
      EXPECT_GT(second - first, 0.4 * spread);
      break;
    case EnergyTrend::Drifts:
      EXPECT_GT(std::abs(second - first), 0.4 * spread);
      break;
    case EnergyTrend::Bounded:
      EXPECT_LT(std::abs(second - first), 0.1 * spread);
      break;
    case EnergyTrend::Falls:
      EXPECT_LT(second - first, -0.4 * spread);
      break;
  }
}

// the range of the energy within 8 s of the swinging net, in frames of 1/50 s
double energy_fluctuation(const Integrator& method, int substeps) {
  TestSim sim = net(8, 1e2, 0.0);
  const double start = compute_energy(sim.system, sim.state).total();
  double max = 0.0;
  for (int frame = 0; frame < 400; ++frame) {
    sim.run(method, 0.02, substeps);
    max = std::max(max, std::abs(compute_energy(sim.system, sim.state).total() - start));
  }
  return max;
}

TEST(Energy, FluctuatesByTheOrderOfTheMethodUnderSymplecticMethods) {
  for (const Integrator& row : integrators()) {
    if (!row.is_symplectic()) continue;
    const int substeps = row.order > 2 ? 2 : 16;
    EXPECT_NEAR(std::log2(energy_fluctuation(row, substeps) / energy_fluctuation(row, 2 * substeps)), row.order, 0.3) << row.id;
  }
}

TEST(Energy, IsTheSumOfItsParts) {
  TestSim sim;
  const PointId first = sim.add({1.0, 2.0, 3.0}, 2.0, {3.0, 0.0, 4.0}), second = sim.add({1.0, 2.0, 5.0}, 0.5);
  sim.join(first, second, 100.0, 1.5);
  sim.nail({0.0, 7.0, 0.0});
  sim.system.grab = Grab{.point = second, .kind = GrabKind::Pull, .stiffness = 8.0};
  sim.state.hand.position = {1.0, 2.0, 6.0};
  const Energy energy = compute_energy(sim.system, sim.state);
  EXPECT_DOUBLE_EQ(energy.kinetic, 25.0);
  EXPECT_DOUBLE_EQ(energy.elastic, 0.5 * 100.0 * 0.25 + 0.5 * 8.0);
  EXPECT_DOUBLE_EQ(energy.gravitational, 9.81 * 2.0 * 2.5);
  EXPECT_DOUBLE_EQ(energy.total(), energy.kinetic + energy.elastic + energy.gravitational);

  const Momentum momentum = compute_momentum(sim.system, sim.state);
  EXPECT_LT(glm::distance(momentum.linear, Vec3(6.0, 0.0, 8.0)), 1e-14);
  EXPECT_LT(glm::distance(momentum.angular, Vec3(16.0, 10.0, -12.0)), 1e-14);
}

// [W] dissipated by dashpots and drag: sum d w^2 + sum c m v^2
double dissipation(const System& system, const State& state) {
  double power = 0.0;
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const Vec3 along = glm::normalize(state.position[i] - state.position[j]);
    const double w = glm::dot(state.velocity[i] - state.velocity[j], along);
    power += system.damping_of(spring) * w * w;
  }
  for (Index i = 0; i < system.point_count(); ++i)
    if (!system.points()[i].nailed) power += system.drag_rate() * system.points()[i].mass * glm::dot(state.velocity[i], state.velocity[i]);
  return power;
}

// E(t) - E(0) = - integral of the dissipation, by the trapezoidal rule: at best second order
TEST_P(Conservation, OfEnergyMinusDissipation) {
  const auto missing = [&](int frames) {
    TestSim sim = net(6, 1e2, 0.3);
    sim.system.drag = 0.7;
    const Energy start = compute_energy(sim.system, sim.state);
    double lost = 0.0, before = dissipation(sim.system, sim.state);
    for (int frame = 0; frame < frames; ++frame) {
      sim.run(method(), 1.0 / frames, 4);
      const double after = dissipation(sim.system, sim.state);
      lost += 0.5 * (before + after) / frames;
      before = after;
    }
    EXPECT_GT(lost, 0.1 * start.kinetic);
    return std::abs(compute_energy(sim.system, sim.state).total() + lost - start.total());
  };
  const int order = std::min({2, method().order_with.damped, method().order_with.drag});
  expect_order(missing, order == 1 ? 800 : 100, order, 0.2);
}

}  // namespace
}  // namespace hooke
