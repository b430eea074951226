// Contact close to nails: springs and faces are levers there, whose other ends could reach any speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "support/convergence.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// One or two springs nailed at one end, and another spring, one end of which the hand drags across them, often close to a nail.
struct Drag {
  TestSim sim;
  Index held = 0;
  Vec3 from{0.0}, velocity{0.0};  // [m], [m/s], of the hand
  int substeps = 1;

  explicit Drag(std::uint64_t seed) {
    Random random(seed * 91 + 3);
    const bool is_flat = random.one_in(2);
    sim.system.dimensions = is_flat ? 2 : 3;
    sim.system.gravity = Vec3(0.0);
    const double thickness = random.uniform(0.002, 0.02), friction = random.one_in(2) ? 0.0 : random.uniform(0.0, 1.0);
    sim.system.contact = {.springs = true, .thickness = thickness, .friction = friction};
    const double stiffness = std::pow(10.0, random.uniform(1.0, 4.0)), mass = random.uniform(0.05, 0.5);
    const double speed = std::pow(10.0, random.uniform(-0.5, 1.0));
    const Index bars = 1 + random.below(2);
    for (Index b = 0; b < bars; ++b) {
      const Vec3 at(random.uniform(-0.1, 0.1), 0.1 * b, 0.0);
      const double length = random.uniform(0.3, 0.6), slope = random.uniform(-0.05, 0.05);
      const PointId nail = sim.nail(at), end = sim.add(at + Vec3(length, slope, 0.0), mass);
      sim.join(nail, end, stiffness, length, random.one_in(2) ? 0.0 : 0.1);
    }
    const double x = random.uniform(0.0, 0.3), z = random.uniform(-0.05, 0.05), aside = random.uniform(-0.2, 0.2);
    from = Vec3(x, -0.15, is_flat ? 0.0 : z);
    velocity = speed * glm::normalize(Vec3(random.uniform(-0.3, 0.3), 1.0, 0.0));
    const PointId grabbed = sim.add(from, mass), other = sim.add(from + (is_flat ? Vec3(aside, -0.3, 0.0) : Vec3(aside, 0.0, 0.3)), mass);
    sim.join(grabbed, other, stiffness, glm::distance(sim.position(grabbed), sim.position(other)));
    sim.system.grab = Grab{.point = grabbed, .kind = GrabKind::Hold};
    held = sim.system.index_of(grabbed);
    substeps = 2 + static_cast<int>(std::sqrt(4.0 * stiffness / mass) / 60.0 * 8.0);
  }

  double step() const { return 1.0 / 60.0 / substeps; }

  // Advances by a substep. Returns by how much contact changed the velocity of a point in it, relative to the largest difference of the
  // velocities of two points without contact.
  double leverage(const Integrator& method) {
    sim.state.hand.position = sim.state.position[held];
    sim.state.hand.target = sim.state.position[held] + step() * velocity;
    TestSim free = sim;
    free.system.contact = {};
    free.run(method, step(), 1);
    std::vector<Vec3> before = sim.state.velocity, after = free.state.velocity;
    sim.run(method, step(), 1);
    double change = 0.0, difference = 0.0;
    before[held] = after[held] = velocity;
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (static_cast<Index>(i) != held) change = std::max(change, glm::distance(sim.state.velocity[i], after[i]));
      for (std::size_t j = 0; j < i; ++j)
        difference = std::max({difference, glm::distance(before[i], before[j]), glm::distance(after[i], after[j])});
    }
    return change / difference;
  }
};

class Leverage : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Leverage,
                         testing::ValuesIn(methods_that([](const Integrator& method) { return method.advance == nullptr; })), method_name);

// Up to 28000 without the limit, and speeds of 30 km/s.
TEST_P(Leverage, OfSpringsThatAHandDragsAcrossEachOtherIsLimited) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Drag drag(seed);
    const int steps = static_cast<int>(0.5 / glm::length(drag.velocity) / drag.step());
    for (int i = 0; i < steps; ++i) ASSERT_LT(drag.leverage(method()), 11.0) << seed << ", substep " << i;
  }
}

// A spring that the hand pushes at a third of its length turns about its nail like a rod: its end is three times as fast.
TEST(LeverageOfARod, IsThatOfItsLength) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.contact = {.springs = true, .thickness = 0.01};
  const PointId nail = sim.nail({0.0, 0.0, 0.0}), end = sim.add({0.6, 0.0, 0.0}, 0.1);
  sim.join(nail, end, 100.0, 0.6);
  const PointId grabbed = sim.add({0.2, -0.02, -0.2}, 0.1), other = sim.nail({0.2, -0.02, 0.2});
  sim.join(grabbed, other, 0.0, 0.4);
  sim.system.grab = Grab{.point = grabbed, .kind = GrabKind::Hold};
  const double speed = 1.0, seconds = 0.05;
  for (int i = 0; i < 50; ++i) {
    sim.state.hand.position = sim.position(grabbed);
    sim.state.hand.target = sim.position(grabbed) + Vec3(0.0, speed * seconds / 50, 0.0);
    sim.run(default_integrator(), seconds / 50, 1);
  }
  // the middle of the dragged spring moves at half the speed of the hand
  EXPECT_NEAR(sim.velocity(end).y, 0.5 * speed * 0.6 / 0.2, 0.05);
}

}  // namespace
}  // namespace hooke
