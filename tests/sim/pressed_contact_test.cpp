// Sheets that are pressed on something with friction.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/folds.h"

namespace hooke {
namespace {

PointId add_ball(TestSim& sim, const Vec3& position, double radius, double mass) {
  const PointId id = sim.add(position, mass);
  sim.system.point(sim.system.index_of(id)).radius = radius;
  return id;
}

double max_strain(const TestSim& sim) {
  double max = 0.0;
  for (const Spring& spring : sim.system.springs())
    max = std::max(max, glm::distance(sim.position(spring.first), sim.position(spring.second)) / spring.rest_length - 1.0);
  return max;
}

// What the ball presses closer than the thickness must not creep apart along the sheet while friction holds what its springs pull back.
TEST(PressedContact, DoesNotStretchASheetBetweenTwoBalls) {
  for (const double friction : {0.0, 1.0, 3.0}) {
    TestSim sim;
    sim.system.gravity = {0.0, 0.0, -9.81};
    sim.system.drag = 1.0;
    folds::add_sheet(
        sim, 13, [](double u, double v) { return Vec3(0.6 * u - 0.3, 0.6 * v - 0.3, 0.0); }, folds::at_rest);
    SpringList springs;
    for (Spring spring : sim.system.springs()) {
      spring.stiffness /= 3.0;
      spring.damping = 0.02;
      spring.rest_length *= 0.6;
      springs.push_back(spring);
    }
    sim.system.set_springs(springs);
    const PointId below = add_ball(sim, {0.0, 0.0, -0.161}, 0.15, 1.0);
    sim.system.point(sim.system.index_of(below)).nailed = true;
    const PointId above = add_ball(sim, {0.0, 0.0, 0.069}, 0.05, 0.2);
    folds::touch(sim, friction);
    sim.system.contact.thickness = 0.01;
    for (int frame = 0; frame < 90; ++frame) sim.run(*find_integrator("velocity_verlet"), 1.0 / 60.0, 40);
    EXPECT_LT(max_strain(sim), 0.07) << friction;
    EXPECT_LT(sim.position(above).z, 0.07) << friction;
  }
}

}  // namespace
}  // namespace hooke
