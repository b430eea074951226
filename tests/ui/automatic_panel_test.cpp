// The method `auto` in the panels.
#include <gtest/gtest.h>

#include "sim/automatic/automatic.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"

namespace hooke {
namespace {

Scene scene_of_two_springs() {
  TestSim sim;
  const PointId a = sim.nail({-0.5, 0.0, 0.0}), b = sim.add({0.0, 0.0, 0.0}), c = sim.add({0.5, 0.0, 0.0});
  sim.join(a, b, 100.0, 0.5);
  sim.join(b, c, 100.0, 0.5);
  return flat_scene("Two springs", sim);
}

// First in the list, with a slider of its own, and it says what it chose.
TEST(Methods, TheAutomaticOneHasATolerance) {
  GuiFixture gui(scene_of_two_springs());
  EXPECT_LT(gui.find("side", {"tolerance", "##value"}).x, 0.0);
  gui.app().handle(Request(Edit{SetIntegrator{&automatic_method()}}));
  gui.app().handle(Request(Control(StepOnce{})));
  gui.frames(3);
  EXPECT_GT(gui.find("side", {"tolerance", "##value"}).x, 0.0);
  ASSERT_TRUE(gui.status().snapshot->state.memory.choice);
  EXPECT_NE(gui.text().find("Chosen"), std::string::npos);
  gui.key(letter('Z'), {.control = true});
  EXPECT_EQ(gui.status().snapshot->settings.integrator, &default_integrator());
}

}  // namespace
}  // namespace hooke
