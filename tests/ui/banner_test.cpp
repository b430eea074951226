// The banner that explains why a run stopped, and its remedy.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "sim/integrator.h"
#include "support/two_springs.h"

namespace hooke {
namespace {

// Builds frames until the search for a remedy is over.
std::string words_with_remedy(GuiFixture& gui) {
  for (int i = 0; i < 6000; ++i) {
    std::string words = gui.text();
    for (const char* outcome : {"Start over with ", "Continue from ", "No remedy"})
      if (words.find(outcome) != std::string::npos) return words;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return {};
}

// Two springs far beyond the stability limit of the method.
Scene unstable_springs() {
  Scene scene = two_springs();
  scene.settings.integrator = find_integrator("velocity_verlet");
  scene.settings.substeps = 1;
  for (Index s = 0; s < 2; ++s) scene.system.spring(s).stiffness = 1e5;
  scene.state.position[2].x = 0.6;
  return scene;
}

void run_until_it_stops(GuiFixture& gui) {
  gui.key(Key::Space);
  for (int i = 0; i < 2000 && gui.status().diagnosis.message.empty(); ++i) gui.frame();
  ASSERT_FALSE(gui.status().diagnosis.message.empty());
  gui.frames(3);
}

void click_remedy(GuiFixture& gui) {
  gui.frames(3);
  const Rect banner = gui.app().panels().floating.at(0);
  EXPECT_TRUE(panels_cover(gui.app().panels(), gui.app().layout(), banner.x + 5.0, banner.y + 5.0));
  gui.click(gui.find("stopped", {"###remedy"}));
  EXPECT_TRUE(gui.status().diagnosis.message.empty());
  EXPECT_TRUE(gui.status().run.running);
}

void expect_to_run_through(GuiFixture& gui, double until) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (gui.status().diagnosis.message.empty() && gui.status().snapshot->state.time < until && std::chrono::steady_clock::now() < deadline)
    gui.frame();
  EXPECT_EQ(gui.status().diagnosis.message, "");
  EXPECT_GE(gui.status().snapshot->state.time, until);
}

TEST(Banner, ExplainsWhyTheRunStoppedAndRestartsWithATestedSetting) {
  Scene scene = two_springs();
  scene.settings.integrator = find_integrator("explicit_euler");
  scene.settings.substeps = 2;
  for (Index s = 0; s < 2; ++s) scene.system.spring(s).stiffness = 1e4;
  scene.state.position[2].x = 0.6;
  GuiFixture gui(scene);
  run_until_it_stops(gui);
  const std::string words = words_with_remedy(gui);
  EXPECT_NE(words.find("Start over with "), std::string::npos) << words;
  EXPECT_NE(words.find("(tested for "), std::string::npos) << words;
  click_remedy(gui);
  EXPECT_NE(gui.status().snapshot->settings.integrator, find_integrator("explicit_euler"));
  expect_to_run_through(gui, 1.0);
}

// Back to start keeps parameters that were changed during the run, and the remedy is tested with them.
TEST(Banner, AfterAnEditDuringTheRunStartsOverWithTheEditedParameters) {
  Scene scene = unstable_springs();
  for (Index s = 0; s < 2; ++s) scene.system.spring(s).stiffness = 100.0;
  GuiFixture gui(scene);
  gui.key(Key::Space);
  while (gui.status().snapshot->state.time < 1.0) gui.frame();
  gui.app().handle(Request(Edit{RestoreParameter{find_parameter("stiffness"), 1e5}}));
  for (int i = 0; i < 2000 && gui.status().diagnosis.message.empty(); ++i) gui.frame();
  ASSERT_FALSE(gui.status().diagnosis.message.empty());
  const std::string words = words_with_remedy(gui);
  ASSERT_NE(words.find("Start over with "), std::string::npos) << words;
  click_remedy(gui);
  EXPECT_EQ(gui.status().snapshot->system->springs()[0].stiffness, 1e5);
  expect_to_run_through(gui, 1.0);
}

TEST(Banner, StaysWhileParametersAreTunedUntilTheyResolveTheProblem) {
  GuiFixture gui(unstable_springs());
  run_until_it_stops(gui);
  const std::string message = "The simulation blew up: ";
  gui.key(Key::Up);
  EXPECT_NE(gui.text().find(message), std::string::npos);
  gui.key(letter('Z'), {.control = true});
  EXPECT_NE(gui.text().find(message), std::string::npos);
  gui.app().handle(Request(Edit{SetParameter{find_parameter("substeps"), 1000.0}}));
  gui.frames(2);
  EXPECT_EQ(gui.text().find(message), std::string::npos);
}

TEST(Banner, OnceDismissedStaysHiddenWhileParametersAreTuned) {
  GuiFixture gui(unstable_springs());
  run_until_it_stops(gui);
  words_with_remedy(gui);
  gui.frames(3);
  gui.click(gui.find("stopped", {"Dismiss"}));
  EXPECT_EQ(gui.text().find("The simulation blew up"), std::string::npos);
  gui.key(Key::Up);
  EXPECT_EQ(gui.text().find("The simulation blew up"), std::string::npos);
}

}  // namespace
}  // namespace hooke
