// Detection of divergence: what is reported and what is not.
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>

#include "sim/forces/force_terms.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/nets.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

class DivergenceDetection : public EveryMethod {
 protected:
  // The number of frames until a divergence is detected, or `max` if there is none.
  int frames_until_divergence(TestSim& sim, int substeps, int max) {
    initialize_supply(sim.system, sim.state);
    for (int frame = 0; frame < max; ++frame) {
      sim.run(method(), 1.0 / 60.0, substeps);
      if (find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state))) return frame;
    }
    return max;
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, DivergenceDetection, testing::ValuesIn(every_method()), method_name);

// a point has no extent, and the only energy supplied is potential energy from its height
TEST_P(DivergenceDetection, AcceptsASinglePointThatFallsAndBounces) {
  TestSim sim;
  sim.add({0.0, 1.0, 0.0});
  sim.system.colliders = {{.shape = Plane{}, .restitution = 0.9}};
  EXPECT_EQ(frames_until_divergence(sim, 4, 300), 300);
}

// after 20 s of falling the energy is 2e5 times what a scene of 0.1 mm can store, and the error of explicit Euler is h / t of it
TEST_P(DivergenceDetection, AcceptsALongFallOfATinyScene) {
  TestSim sim;
  sim.join(sim.add({0.0, 0.0, 0.0}), sim.add({1e-4, 0.0, 0.0}), 1.0, 1e-4);
  EXPECT_EQ(frames_until_divergence(sim, 1, 1200), 1200);
}

TEST_P(DivergenceDetection, StopsASpringThatIsFarTooStiffForTheStep) {
  if (method().stability != Stability::None && method().stability != Stability::Conditional) return;
  TestSim sim;
  sim.join(sim.nail(Vec3(0.0)), sim.add({0.0, -1.1, 0.0}), 1e8, 1.0);
  EXPECT_LT(frames_until_divergence(sim, 1, 60), 10);
}

// In its first step, explicit Euler gains kinetic energy before the points move, that is before a force does work.
TEST_P(DivergenceDetection, AcceptsAStartFromRestUnderEveryListedForce) {
  for (const ForceTerm& term : force_terms()) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const std::array corners{sim.add({0.0, 1.0, 0.0}, 0.3), sim.add({1.0, 1.1, 0.0}, 0.4), sim.add({0.0, 1.2, 0.9}, 0.5)};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      sim.system.point(static_cast<Index>(i)).radius = 0.1;
      sim.join(corners[i], corners[(i + 1) % 3], 1e-6, 1.4);
    }
    sim.system.faces.push_back({.points = corners});
    Force force{.term = &term};
    for (std::size_t k = 0; k < term.numbers.size(); ++k) force.values[k] = term.numbers[k].default_value;
    sim.system.forces = {force};
    EXPECT_EQ(frames_until_divergence(sim, 1, 60), 60) << term.id;
  }
}

TEST_P(DivergenceDetection, AcceptsAnEndlessFall) {
  TestSim sim;
  sim.add({0.0, 1.0, 0.0});
  EXPECT_EQ(frames_until_divergence(sim, 1, 20000), 20000);
}

// without a nail, the whole net keeps accelerating
TEST_P(DivergenceDetection, AcceptsANetThatFallsForAHundredSeconds) {
  TestSim sim = net(5, 1e2, 0.1);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = false;
  // explicit Euler amplifies transverse vibrations, which dashpots do not damp
  const bool holds = method().stability != Stability::None;
  EXPECT_EQ(frames_until_divergence(sim, holds ? 4 : 20, holds ? 6000 : 60), holds ? 6000 : 60);
}

TEST_P(DivergenceDetection, AcceptsEnergyLossThroughDrag) {
  TestSim sim = net(4, 1e2, 0.1);
  sim.system.drag = 1.0;
  sim.system.wind = {20.0, 0.0, 0.0};
  EXPECT_EQ(frames_until_divergence(sim, 20, 600), 600);
}

// 8 x 8 points 0.1 m apart, 0.01 kg each, k = 10 N/m, the top row nailed
TestSim square_net() {
  TestSim sim;
  for (int i = 0; i < 64; ++i) {
    const int row = i / 8, column = i % 8;
    sim.add({0.1 * column, -0.1 * row, 0.0}, 0.01);
    sim.system.point(i).nailed = i < 8;
  }
  const auto join = [&](int from, int to) { sim.join(sim.system.points()[from].id, sim.system.points()[to].id, 10.0, 0.1); };
  for (int i = 0; i < 64; ++i) {
    if (i % 8 < 7) join(i, i + 1);
    if (i < 56) join(i, i + 8);
  }
  return sim;
}

TEST_P(DivergenceDetection, StopsTheNetThatOnlyExplicitEulerBlowsUp) {
  TestSim sim = square_net();
  const int frames = frames_until_divergence(sim, 10, 1200);
  if (method().stability == Stability::None) {
    EXPECT_LT(frames, 1200);
  } else {
    EXPECT_EQ(frames, 1200);
  }
}

// Valid scenes whose grab target jumps by one meter per frame, with repeated grabs and releases and parameters that jump.
TEST_P(DivergenceDetection, AcceptsErraticGrabsAndParameterChanges) {
  if (method().stability == Stability::None) return;
  Random random(9);
  TestSim sim = net(5, 1e2, 0.0);
  initialize_supply(sim.system, sim.state);
  for (int frame = 0; frame < 400; ++frame) {
    const double energy = compute_energy(sim.system, sim.state).total();
    if (frame % 40 == 0) {
      // release, change every k and d by a factor of a hundred up or down, grab another point
      sim.system.grab.reset();
      for (Index s = 0; s < sim.system.spring_count(); ++s) {
        sim.system.spring(s)->stiffness = random.one_in(2) ? 1e2 : 1e4;
        sim.system.spring(s)->damping = random.one_in(2) ? 0.0 : 0.5;
      }
      const Index point = 5 + random.below(20);
      sim.system.grab = Grab{.point = sim.system.points()[point].id, .kind = frame % 80 == 0 ? GrabKind::Hold : GrabKind::Pull};
      sim.state.hand.position = sim.state.position[point];
      record_edit_energy(sim.system, compute_energy(sim.system, sim.state).total() - energy, sim.state);
    }
    sim.state.hand.target = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    sim.run(method(), 1.0 / 60.0, 60);
    ASSERT_FALSE(find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state))) << "frame " << frame;
  }
}

// 12 x 12 free points of 1 kg, k = 1e6 N/m: a corner is dragged around a circle of 1 m at 50 m/s for 10 frames and released. Ends after 30
// frames, or earlier at a divergence.
struct Swing {
  int frames = 0;
  double max_energy = 0.0, max_gain = 0.0;  // [J], the maximum energy and the maximum error of the energy balance
};
Swing swing_stiff_sheet(const Integrator& method, int substeps) {
  constexpr int n = 12;
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.drag = 2.0;
  for (int i = 0; i < n * n; ++i) {
    const int row = i / n, column = i % n;
    sim.add({column / 11.0, -row / 11.0, 0.0}, 1.0 / (n * n));
  }
  const auto join = [&](int from, int to) { sim.join(sim.system.points()[from].id, sim.system.points()[to].id, 1e6, 1.0 / 11.0); };
  for (int i = 0; i < n * n; ++i) {
    if (i % n < n - 1) join(i, i + 1);
    if (i < n * (n - 1)) join(i, i + n);
  }
  initialize_supply(sim.system, sim.state);

  Swing swing;
  for (; swing.frames < 30; ++swing.frames) {
    const double angle = 50.0 / 60.0 * (swing.frames + 1);
    sim.system.grab.reset();
    if (swing.frames < 10) sim.system.grab = Grab{.point = sim.system.points()[0].id, .kind = GrabKind::Hold};
    sim.state.hand = {.position = sim.state.position[0], .target = {std::cos(angle) - 1.0, std::sin(angle), 0.0}};
    sim.run(method, 1.0 / 60.0, substeps);
    const Energy energy = compute_energy(sim.system, sim.state);
    if (find_divergence(sim.system, sim.state, energy)) break;
    swing.max_energy = std::max(swing.max_energy, energy.total());
    swing.max_gain = std::max(swing.max_gain, energy.total() - sim.state.supply.net_input);
  }
  return swing;
}

// A single linear solve per step rotates springs by more than their length. Their energy is then a thousand times what the hand supplied
// and disappears again some steps later. This is not a divergence, and it is not recorded as supplied energy either.
TEST(DivergenceDetection, AcceptsAStiffSheetTurnedByAFastHandUnderALinearlyImplicitMethod) {
  const Integrator& linear = *find_integrator("baraff_witkin");
  const Swing swing = swing_stiff_sheet(linear, 1);
  EXPECT_EQ(swing.frames, 30);
  EXPECT_GT(swing.max_gain, 0.9 * swing.max_energy) << "the energy balance must still show the error";
  EXPECT_EQ(swing_stiff_sheet(linear, 4).frames, 30);
  EXPECT_EQ(swing_stiff_sheet(*find_integrator("implicit_euler"), 1).frames, 30);
}

TEST(DivergenceDetection, StopsAStiffSheetThatBlowsUpUnderAFastHand) {
  for (const char* method : {"explicit_euler", "symplectic_euler", "velocity_verlet", "runge_kutta4"})
    EXPECT_LT(swing_stiff_sheet(*find_integrator(method), 4).frames, 3) << method;
}

TEST(DivergenceDetection, AcceptsRestWithoutGravity) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.join(sim.add(Vec3(0.0)), sim.add({1.0, 0.0, 0.0}), 100.0, 1.0 - 1e-16);
  sim.add({5.0, 0.0, 0.0});
  initialize_supply(sim.system, sim.state);
  for (int frame = 0; frame < 100; ++frame) {
    sim.run(default_integrator(), 1.0 / 60.0, 1);
    ASSERT_FALSE(find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state))) << "frame " << frame;
  }
}

TEST(DivergenceDetection, NamesTheNonFinitePointAndItsSpring) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (const bool in_velocity : {false, true}) {
      TestSim sim = net(4, 1e2, 0.0);
      initialize_supply(sim.system, sim.state);
      (in_velocity ? sim.state.velocity : sim.state.position)[9].y = bad;
      EXPECT_FALSE(is_finite(sim.state));
      const auto found = find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state));
      ASSERT_TRUE(found);
      EXPECT_EQ(found->kind, Divergence::Kind::NotFinite);
      EXPECT_EQ(found->point, sim.system.points()[9].id);
      ASSERT_TRUE(found->spring);
      const Spring& spring = sim.system.springs()[sim.system.index_of(*found->spring)];
      EXPECT_TRUE(spring.first == *found->point || spring.second == *found->point);
    }
}

// an unstable point can drive the others to infinity within one frame
TEST(DivergenceDetection, NamesTheLightPointOfAChainThatDivergesInOneFrame) {
  TestSim sim;
  PointId last = sim.add(Vec3(0.0));
  for (int i = 1; i < 12; ++i) {
    const PointId next = sim.add({0.1 * i, 0.01 * (i % 2), 0.0}, i == 7 ? 1e-6 : 1.0);
    sim.join(last, next, 1e4, 0.1);
    last = next;
  }
  initialize_supply(sim.system, sim.state);
  sim.run(*find_integrator("blanes_moan4"), 1.0 / 60.0, 40);
  ASSERT_FALSE(is_finite(sim.state));
  const auto found = find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state));
  ASSERT_TRUE(found);
  EXPECT_EQ(sim.system.index_of(*found->point), 7);
}

TEST(DivergenceDetection, NamesTheFastestPointAndItsMostStretchedSpring) {
  TestSim sim = net(4, 1e2, 0.0);
  initialize_supply(sim.system, sim.state);
  sim.state.velocity[9] = {1e5, 0.0, 0.0};
  sim.state.velocity[1] = {1e6, 0.0, 0.0};  // nailed
  sim.system.spring(3)->stiffness = 1e9;
  sim.state.position[9].x += 3.0;
  const auto found = find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Divergence::Kind::EnergyGain);
  EXPECT_EQ(found->point, sim.system.points()[9].id);
  EXPECT_GT(found->energy, divergence_factor * found->scale);
  double highest = 0.0;
  SpringId stretched{};
  for (const Spring& spring : sim.system.springs()) {
    if (spring.first != *found->point && spring.second != *found->point) continue;
    const double energy = spring.stiffness * std::pow(strain(sim.system, sim.state, spring) * spring.rest_length, 2);
    if (energy > highest) {
      highest = energy;
      stretched = spring.id;
    }
  }
  EXPECT_EQ(found->spring, stretched);
}

}  // namespace
}  // namespace hooke
