// A pull at a position between three points: one spring from the weighted position to the hand, its force distributed by the weights.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "sim/forces/forces.h"
#include "sim/forces/hand.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr std::array weights{0.2, 0.5, 0.3};
constexpr double stiffness = 60.0;

Grab pull(const TestSim& sim, std::array<Index, 3> points) {
  Grab grab{.point = sim.system.points()[points[1]].id, .kind = GrabKind::Pull, .stiffness = stiffness};
  grab.patch = Patch{.weights = weights};
  for (std::size_t p = 0; p < 3; ++p) grab.patch->points[p] = sim.system.points()[points[p]].id;
  return grab;
}

// Three points of different masses without springs between them, pulled by a hand at rest.
struct ThreePointScene {
  TestSim sim;
  std::array<double, 3> mass{0.5, 0.8, 1.5};
  ThreePointScene(bool first_is_nailed = false) {
    sim.system.gravity = Vec3(0.0);
    const Vec3 places[] = {{0.1, 0.0, 0.2}, {1.0, 0.3, -0.1}, {0.2, 0.9, 0.4}};
    for (int i = 0; i < 3; ++i) sim.add(places[i], mass[i]);
    sim.system.point(0).nailed = first_is_nailed;
    sim.state.hand = {.position = {0.3, -0.2, 0.1}, .target = {0.3, -0.2, 0.1}};
    sim.system.grab = pull(sim, {0, 1, 2});
  }
  double give() const {  // [1/kg], acceleration of the grabbed position per force on it
    double sum = 0.0;
    for (Index i = 0; i < 3; ++i) sum += sim.system.points()[i].nailed ? 0.0 : weights[i] * weights[i] / mass[i];
    return sum;
  }
};

class PulledPatch : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, PulledPatch, testing::ValuesIn(every_method()), method_name);

// the grabbed position oscillates about the hand with w^2 = k sum s_i^2 / m_i; the points follow in proportion to s_i / m_i
TEST_P(PulledPatch, OscillatesAboutTheHand) {
  for (const bool nailed : {false, true}) {
    const auto error = [&](int steps) {
      ThreePointScene three(nailed);
      const State start = three.sim.state;
      const Vec3 reach = grabbed_position(three.sim.system, start) - start.hand.position;
      const double w = std::sqrt(stiffness * three.give()), seconds = 3.0 / w;
      three.sim.run(method(), seconds, steps);
      double worst = 0.0;
      for (Index i = 0; i < 3; ++i) {
        const double part = nailed && i == 0 ? 0.0 : weights[i] / three.mass[i] / three.give();
        const Vec3 exact = start.position[i] + part * (std::cos(3.0) - 1.0) * reach;
        worst = std::max(worst, glm::distance(three.sim.state.position[i], exact));
      }
      return worst;
    };
    expect_order(error, asymptotic_steps(method().order), method().order, 0.2);
  }
}

TEST_P(PulledPatch, InTwoDimensionsStaysInThePlane) {
  ThreePointScene three;
  three.sim.system.dimensions = 2;
  for (Vec3& place : three.sim.state.position) place.z = 0.0;
  three.sim.state.hand.position.z = three.sim.state.hand.target.z = 0.0;
  const double before = compute_energy(three.sim.system, three.sim.state).total();
  three.sim.run(method(), 0.1, 400);
  for (const Vec3& place : three.sim.state.position) EXPECT_EQ(place.z, 0.0);
  const double after = compute_energy(three.sim.system, three.sim.state).total();
  EXPECT_NEAR(after / before, 1.0, 0.02);
}

TEST(Patch, ForceIsMinusTheGradientOfTheEnergy) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    TestSim sim = random_sim(seed, 8, 12);
    sim.state.hand = {.position = {0.4, -0.3, 0.8}, .target = {0.4, -0.3, 0.8}};
    sim.system.grab = pull(sim, {1, 4, 6});
    Plan plan = make_plan(sim.system);
    prepare_hand(plan, sim.system, sim.state, 1.0);
    Motion motion;
    pack(plan, sim.state, motion);
    Field f(motion.x.size());
    compute_position_forces(plan, 0.0, motion.x, motion.v, f);

    constexpr double small = 1e-5;
    for (Index i = 0; i < 8; ++i) {
      if (sim.system.points()[i].nailed) continue;
      for (int c = 0; c < 3; ++c) {
        const auto energy_at = [&](double shift) {
          State moved = sim.state;
          moved.position[i][c] += shift;
          return compute_energy(sim.system, moved).total();
        };
        EXPECT_NEAR(f[c * 8 + i], -(energy_at(small) - energy_at(-small)) / (2.0 * small), 1e-6);
      }
    }
  }
}

// Momentum changes by the force of the hand, applied at the grabbed position.
TEST(Patch, TransmitsTheForceAndTorqueOfTheHand) {
  const ThreePointScene three;
  Plan plan = make_plan(three.sim.system);
  prepare_hand(plan, three.sim.system, three.sim.state, 1.0);
  Motion motion;
  pack(plan, three.sim.state, motion);
  Field f(motion.x.size());
  compute_position_forces(plan, 0.0, motion.x, motion.v, f);
  Vec3 force(0.0), torque(0.0);
  for (Index i = 0; i < 3; ++i) {
    const Vec3 on_point(f[i], f[3 + i], f[6 + i]);
    force += on_point;
    torque += glm::cross(three.sim.state.position[i], on_point);
  }
  const Vec3 hand = hand_force(plan, motion);
  EXPECT_LT(glm::distance(hand, stiffness * (three.sim.state.hand.position - grabbed_position(three.sim.system, three.sim.state))), 1e-12);
  EXPECT_LT(glm::distance(force, hand), 1e-12);
  EXPECT_LT(glm::distance(torque, glm::cross(grabbed_position(three.sim.system, three.sim.state), hand)), 1e-12);
}

// Springs without rest length and the pull are linear: implicit Euler needs one Newton iteration with the exact matrix at any stiffness,
// although no spring connects the three points that the pull couples.
TEST(Patch, IsFullyRepresentedInTheMatrixOfImplicitMethods) {
  for (const int dimensions : {2, 3})
    for (const double k : {60.0, 1e7}) {
      ThreePointScene three;
      three.sim.system.dimensions = dimensions;
      const PointId nail = three.sim.nail({0.5, -0.5, 0.0}), beside = three.sim.add({0.6, 0.2, 0.0}, 0.7);
      three.sim.join(nail, PointId{1}, 90.0, 0.0);
      three.sim.join(beside, PointId{2}, 40.0, 0.0);
      three.sim.system.grab->stiffness = k;
      if (dimensions == 2)
        for (Vec3& place : three.sim.state.position) place.z = 0.0;
      TestSim converged = three.sim;
      three.sim.run(*find_integrator("baraff_witkin"), 0.2, 1);
      converged.run(*find_integrator("implicit_euler"), 0.2, 1);
      for (Index i = 0; i < 5; ++i) EXPECT_LT(glm::distance(three.sim.state.position[i], converged.state.position[i]), 1e-8) << k;

      // the grabbed position moves as k alone would move it: v' = h k (target - p') sum s^2/m, since the other springs are soft
      if (k > 1e6) {
        const Vec3 place = grabbed_position(three.sim.system, three.sim.state);
        EXPECT_LT(std::hypot(place.x - 0.3, place.y + 0.2), 1e-4);
      }
    }
}

TEST(Patch, ReachesTheHandInOneStepAtInfiniteStiffness) {
  for (const char* id : {"xpbd", "baraff_witkin", "implicit_euler", "tr_bdf2"})
    for (const bool nailed : {false, true}) {
      ThreePointScene three(nailed);
      three.sim.system.grab->stiffness = 1e11;
      three.sim.run(*find_integrator(id), 0.02, 1);
      EXPECT_LT(glm::distance(grabbed_position(three.sim.system, three.sim.state), three.sim.state.hand.position), 1e-5) << id;
    }
}

TEST(Patch, BoundsTheFrequencyItAdds) {
  const ThreePointScene three;
  EXPECT_GE(bound_spectrum(three.sim.system).omega, std::sqrt(stiffness * three.give()) * (1.0 - 1e-12));
  const ThreePointScene nailed(true);
  EXPECT_GE(bound_spectrum(nailed.sim.system).omega, std::sqrt(stiffness * nailed.give()) * (1.0 - 1e-12));
  EXPECT_LT(bound_spectrum(nailed.sim.system).omega, bound_spectrum(three.sim.system).omega);
}

// energy = initial energy + work of a moving hand, up to the error of the substeps
TEST(Patch, TheWorkOfTheHandIsRecorded) {
  const auto missing = [](int steps) {
    constexpr int frames = 8;
    ThreePointScene three;
    TestSim& sim = three.sim;
    initialize_supply(sim.system, sim.state);
    for (int i = 1; i <= frames; ++i) {
      sim.state.hand.target = Vec3(0.3, -0.2, 0.1) + 0.3 * std::pow(std::sin(3.0 * i / frames), 2) * Vec3(1.0, 0.5, 0.2);
      sim.run(*find_integrator("velocity_verlet"), 1.0 / frames, steps / frames);
    }
    EXPECT_GT(sim.state.supply.scale, 0.1);
    return std::abs(compute_energy(sim.system, sim.state).total() - sim.state.supply.net_input);
  };
  expect_order(missing, 512, 2, 0.2);
}

}  // namespace
}  // namespace hooke
