// The plots and the timeline: one time for both, and no line across a jump in time.
#include <gtest/gtest.h>

#include "support/flat_scene.h"
#include "support/gui_fixture.h"

namespace hooke {
namespace {

Scene swinging() {
  TestSim sim;
  sim.join(sim.nail({0.0, 0.5, 0.0}), sim.add({0.4, 0.3, 0.0}), 100.0, 0.4);
  return flat_scene("Swinging", sim);
}

// With plots of two seconds.
void run_with_plots(GuiFixture& gui) {
  gui.key(letter('P'));
  gui.app().handle(Request(Control(RunTo{2.0})));
  for (int i = 0; i < 2000 && (gui.status().run.running || gui.status().run.frames == 0); ++i) gui.frame();
  gui.app().resize({1280.0, 800.0}, 1.0);
  gui.frames(2);
}

// Where a time is in the only plot.
glm::dvec2 place_of(GuiFixture& gui, double fraction) {
  const Rect& dock = gui.app().layout().plots;
  const double left = dock.x + 78.0 + 56.0, right = dock.x + dock.width - 10.0;
  return {left + fraction * (right - left), dock.y + 0.5 * dock.height};
}

TEST(Plots, AClickGoesToTheTimeUnderTheMouseAndADragDoesNot) {
  GuiFixture gui(swinging());
  run_with_plots(gui);
  gui.click(place_of(gui, 0.25));
  EXPECT_NEAR(gui.status().snapshot->state.time, 0.5, 0.02);
  gui.click(place_of(gui, 0.75));
  EXPECT_NEAR(gui.status().snapshot->state.time, 1.5, 0.02);
  gui.drag(place_of(gui, 0.75), place_of(gui, 0.25));
  EXPECT_NEAR(gui.status().snapshot->state.time, 1.5, 0.02);
}

TEST(Plots, TheTimeUnderTheMouseIsMarkedOnTheTimelineTooAndBack) {
  GuiFixture gui(swinging());
  run_with_plots(gui);
  gui.move(place_of(gui, 0.5));
  gui.frame();
  ASSERT_TRUE(gui.app().panels().time_under_mouse);
  EXPECT_NEAR(*gui.app().panels().time_under_mouse, 1.0, 0.02);
  const Rect& strip = gui.app().layout().timeline;
  gui.move({strip.x + 0.4 * strip.width, strip.y + 0.5 * strip.height});
  gui.frame();
  ASSERT_TRUE(gui.app().panels().time_under_mouse);
  EXPECT_LT(*gui.app().panels().time_under_mouse, 1.0);
  gui.move({400.0, 300.0});
  gui.frames(2);
  EXPECT_FALSE(gui.app().panels().time_under_mouse);
}

TEST(Plots, NoLineLeadsAcrossAJumpInTime) {
  GuiFixture gui(swinging());
  run_with_plots(gui);
  gui.app().handle(Request(Control(GoToTime{0.5})));
  gui.key(Key::Period);
  gui.key(letter('Z'), {.control = true});  // back to two seconds
  gui.key(Key::Period);
  const TraceTable& table = *gui.status().timeline.traces;
  ASSERT_EQ(table.times.size(), table.continues.size());
  std::size_t jumps = 0;
  for (std::size_t i = 1; i < table.times.size(); ++i) {
    const bool is_jump = table.times[i] - table.times[i - 1] > 1.5 / 60.0;
    EXPECT_FALSE(is_jump && table.continues[i] != 0) << table.times[i];
    jumps += is_jump ? 1 : 0;
  }
  EXPECT_EQ(jumps, 1u);
}

TEST(Plots, EscClosesTheListOfQuantities) {
  GuiFixture gui(swinging());
  run_with_plots(gui);
  const glm::dvec2 button = gui.find("plots", {"Choose"});
  ASSERT_GT(button.x, 0.0);
  gui.click(button);
  gui.frames(3);
  EXPECT_TRUE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
  gui.key(Key::Escape);
  gui.frames(2);
  EXPECT_FALSE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
}

}  // namespace
}  // namespace hooke
