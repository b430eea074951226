// The plots and the timeline: one time for both, and no line across a jump in time.
#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"
#include "support/gui_sheets.h"

#include <glm/mat3x3.hpp>

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
  EXPECT_TRUE(gui.wait_for_end_of_run());
  gui.app().resize({1280.0, 800.0}, 1.0);
  gui.frames(2);
}

// Where a time is in the only plot.
glm::dvec2 place_of(GuiFixture& gui, double fraction) {
  const Rect& dock = gui.app().layout().plots;
  const double left = dock.x + 78.0 + 56.0, right = dock.x + dock.width - 10.0;
  return {left + fraction * (right - left), dock.y + 0.5 * dock.height};
}

// In CIE L*a*b*, of linear sRGB.
glm::dvec3 lab(const glm::dvec3& color) {
  const glm::dmat3 to_xyz(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722, 0.9505);
  const glm::dvec3 xyz = to_xyz * glm::clamp(color, 0.0, 1.0) / glm::dvec3(0.9505, 1.0, 1.089);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  return {116.0 * f(xyz.y) - 16.0, 500.0 * (f(xyz.x) - f(xyz.y)), 200.0 * (f(xyz.y) - f(xyz.z))};
}
glm::dvec3 linear(ImU32 color) {
  const auto channel = [&](int shift) { return std::pow(static_cast<double>((color >> shift) & 0xff) / 255.0, 2.2); };
  return {channel(IM_COL32_R_SHIFT), channel(IM_COL32_G_SHIFT), channel(IM_COL32_B_SHIFT)};
}

// Simulated by the matrices of Machado, Oliveira and Fernandes 2009 for linear sRGB, severity 1; a difference of 2.3 is just noticeable.
TEST(Plots, TheColorsOfTheEnergiesDifferWithEveryColorVision) {
  const GuiFixture gui;
  const glm::dmat3 normal(1.0);
  const glm::dmat3 protanopia(0.152286, 0.114503, -0.003882, 1.052583, 0.786281, -0.048116, -0.204868, 0.099216, 1.051998);
  const glm::dmat3 deuteranopia(0.367322, 0.280085, -0.011820, 0.860646, 0.672501, 0.042940, -0.227968, 0.047413, 0.968881);
  const glm::dmat3 tritanopia(1.255528, -0.078411, 0.004733, -0.076749, 0.930809, 0.691367, -0.178779, 0.147602, 0.303900);
  const int elastic = 1, total = 3;
  for (const Look look : {Look::Light, Look::Dark}) {
    use_look(look);
    for (const glm::dmat3& vision : {normal, protanopia, deuteranopia, tritanopia})
      for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b) {
          const double difference = glm::distance(lab(vision * linear(palette::inks[a])), lab(vision * linear(palette::inks[b])));
          EXPECT_GE(difference, 12.0) << a << " and " << b;
          if (a == elastic && b == total && vision != tritanopia) {
            EXPECT_GE(difference, 60.0);
          }
        }
  }
}

TEST(Plots, LabelsOfTicksAtTheEndOfTheAxisAreNotClipped) {
  GuiFixture gui(swinging());
  run_with_plots(gui);
  EXPECT_EQ(faults(*ImGui::GetDrawData()), std::set<std::string>());
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
  ASSERT_TRUE(gui.app().panels().plots.time_under_mouse);
  EXPECT_NEAR(*gui.app().panels().plots.time_under_mouse, 1.0, 0.02);
  const Rect& strip = gui.app().layout().timeline;
  gui.move({strip.x + 0.4 * strip.width, strip.y + 0.5 * strip.height});
  gui.frame();
  ASSERT_TRUE(gui.app().panels().plots.time_under_mouse);
  EXPECT_LT(*gui.app().panels().plots.time_under_mouse, 1.0);
  gui.move({400.0, 300.0});
  gui.frames(2);
  EXPECT_FALSE(gui.app().panels().plots.time_under_mouse);
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

TEST(Plots, AFlatSceneHasOneAngularMomentum) {
  GuiFixture gui(swinging());
  run_with_plots(gui);
  gui.click(gui.find("plots", {"Choose"}));
  gui.frames(3);
  std::string words = gui.text();
  std::erase(words, ' ');
  EXPECT_NE(words.find("Angularmomentumkgm"), std::string::npos) << words;
  EXPECT_EQ(words.find("Angularmomentumabout"), std::string::npos) << words;
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

TEST(Plots, TwoCursorsShowThePeriodAndTheFrequencyBetweenThem) {
  GuiFixture gui(swinging());
  run_with_plots(gui);
  const double time = gui.status().snapshot->state.time;
  for (const double fraction : {0.25, 0.5}) {
    ImGui::GetIO().KeyShift = true;
    gui.click(place_of(gui, fraction), Button::Left, {.shift = true});
    ImGui::GetIO().KeyShift = false;
  }
  const std::string text = gui.text();
  const auto at = text.find("B - A = ");
  ASSERT_NE(at, std::string::npos) << text;
  const double period = std::stod(text.substr(at + 8)), frequency = std::stod(text.substr(text.find('(', at) + 1));
  EXPECT_NEAR(period, 0.5, 0.01);
  EXPECT_NEAR(frequency * period, 1.0, 1e-3);
  EXPECT_EQ(gui.status().snapshot->state.time, time);
}

TEST(Plots, AreSavedWithTheSceneAndShownWhenItIsOpened) {
  Scene scene = swinging();
  {
    GuiFixture gui(scene);
    gui.key(letter('P'));
    gui.app().handle(Request(Edit{SetPlots{{"y1", "length0"}}}));
    gui.frames(3);
    ASSERT_EQ(gui.status().timeline.traces->traces.size(), 2u);
    EXPECT_EQ(gui.status().timeline.traces->traces[0].quantity.name(), "y1");
    EXPECT_TRUE(gui.status().history.unsaved);
  }
  scene.view.plots = {"y1", "length0"};
  const Scene read = parse_scene(format_scene(scene), "memory").scene;
  EXPECT_EQ(read.view.plots, scene.view.plots);
  GuiFixture opened(read);
  EXPECT_TRUE(opened.app().panels().plots.is_shown);
  EXPECT_EQ(opened.status().timeline.traces->traces.size(), 2u);
}

TEST(Plots, TheTitleAndTheNotesAreEditedSavedAndUndone) {
  GuiFixture gui(swinging());
  gui.app().handle(Request(Edit{SetText{"Pendulum", "Swings.", "For lesson 3"}}));
  gui.frames(2);
  EXPECT_NE(gui.text().find("For lesson 3"), std::string::npos);
  Scene scene = swinging();
  scene.notes = "Two\nlines";
  EXPECT_EQ(parse_scene(format_scene(scene), "memory").scene.notes, scene.notes);
  gui.key(letter('Z'), {.control = true});
  EXPECT_EQ(gui.status().document->name, "Swinging");
}

}  // namespace
}  // namespace hooke
