#include "scene/warnings/warnings.h"

#include <gtest/gtest.h>

#include "support/gas_bodies.h"

namespace hooke {
namespace {

TEST(PressureWarning, IsNotGivenForClosedSurfacesOrWithoutTheForce) {
  TestSim ball = gas_ball(1, 1.0, {});
  EXPECT_EQ(pressure_warning(ball.system), std::nullopt);
  EXPECT_EQ(pressure_warning(gas_ring(8, 1.0, {}).system), std::nullopt);
  ball.system.faces.pop_back();
  ball.system.forces[0].on = false;
  EXPECT_EQ(pressure_warning(ball.system), std::nullopt);
}

TEST(PressureWarning, SaysWhichSurfacesAreNotFilled) {
  TestSim ball = gas_ball(1, 1.0, {});
  ball.system.faces.pop_back();
  EXPECT_EQ(
      pressure_warning(ball.system),
      "forces: pressure: fills 0 of the 1 surfaces: the others have edges that do not belong to exactly two faces, or faces whose springs "
      "are missing or have rest lengths that form no triangle");
  ball.system.faces.clear();
  EXPECT_EQ(pressure_warning(ball.system), "forces: pressure: fills closed surfaces of faces only: this scene has none");

  TestSim ring = gas_ring(8, 1.0, {});
  const auto& points = ring.system.points();
  ring.join(points[0].id, points[4].id, 1.0, 1.0);
  EXPECT_EQ(pressure_warning(ring.system), "forces: pressure: fills closed lines of springs only: this scene has none");
  ring.system.faces.push_back({{points[0].id, points[1].id, points[2].id}});
  EXPECT_EQ(
      pressure_warning(ring.system),
      "forces: pressure: fills 0 of the 1 sets of faces: the others have an edge of more than two faces, no springs along their border, "
      "or rest lengths that enclose nothing");
}

}  // namespace
}  // namespace hooke
