// The method `auto` in the panels.
#include <gtest/gtest.h>

#include "sim/automatic/automatic.h"
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

}  // namespace
}  // namespace hooke
