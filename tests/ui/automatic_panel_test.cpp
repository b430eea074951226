// The method `auto` in the panels.
#include <gtest/gtest.h>

#include "sim/control/automatic.h"
#include "support/two_springs.h"

namespace hooke {
namespace {

// First in the list, with a slider of its own, and it says what it chose.
TEST(Methods, TheAutomaticOneHasATolerance) {
  GuiFixture gui(two_springs());
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

// Over all nine decades.
TEST(Methods, TheSliderOfTheToleranceReachesBothEnds) {
  Scene scene = two_springs();
  scene.settings.integrator = &automatic_method();
  GuiFixture gui(scene);
  const Rect side = gui.app().layout().side;
  const glm::dvec2 slider = gui.find("side", {"tolerance", "##value"});
  const auto drag_to = [&](double x) {
    gui.drag(slider, {x, slider.y});
    gui.frames(2);
    return value_of(gui, "tolerance");
  };
  EXPECT_NEAR(drag_to(side.x + 1.0), 1e-10, 1e-12);
  EXPECT_NEAR(drag_to(side.x + side.width - 1.0), 0.1, 1e-9);
}

}  // namespace
}  // namespace hooke
