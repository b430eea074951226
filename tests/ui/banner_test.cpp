// The banner that explains why a run stopped, and its remedy.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

#include "sim/methods/integrator.h"
#include "support/two_springs.h"

namespace hooke {
namespace {

// Builds frames until the search for a remedy is over.
std::string words_with_remedy(GuiFixture& gui) {
  for (int i = 0; i < 6000; ++i) {
    std::string words = gui.text();
    for (const char* outcome : {"Start over with ", "Continue from ", "no remedy"})
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
  for (Index s = 0; s < 2; ++s) scene.system.spring(s)->stiffness = 1e5;
  scene.state.position[2].x = 0.6;
  return scene;
}

void run_until_it_stops(GuiFixture& gui) {
  gui.key(Key::Space);
  EXPECT_TRUE(gui.wait_until([&] { return !gui.status().diagnosis.message.empty(); }));
  ASSERT_FALSE(gui.status().diagnosis.message.empty());
  gui.frames(3);
}

void click_remedy(GuiFixture& gui) {
  gui.frames(3);
  const Rect banner = gui.app().panels().shown.floating.at(0);
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
  for (Index s = 0; s < 2; ++s) scene.system.spring(s)->stiffness = 1e4;
  scene.state.position[2].x = 0.6;
  GuiFixture gui(scene);
  run_until_it_stops(gui);
  const std::string words = words_with_remedy(gui);
  EXPECT_NE(words.find("Start over with "), std::string::npos) << words;
  EXPECT_NE(words.find("(tested for"), std::string::npos) << words;
  click_remedy(gui);
  EXPECT_NE(gui.status().snapshot->settings.integrator, find_integrator("explicit_euler"));
  expect_to_run_through(gui, 1.0);
}

// A run that an edit of the stiffness makes diverge after a second.
void run_and_stiffen(GuiFixture& gui) {
  gui.key(Key::Space);
  while (gui.status().snapshot->state.time < 1.0) gui.frame();
  gui.app().handle(Request(Edit{RestoreParameter{find_parameter("stiffness"), 1e5}}));
  EXPECT_TRUE(gui.wait_until([&] { return !gui.status().diagnosis.message.empty(); }));
  ASSERT_FALSE(gui.status().diagnosis.message.empty());
}

Scene stable_springs() {
  Scene scene = unstable_springs();
  for (Index s = 0; s < 2; ++s) scene.system.spring(s)->stiffness = 100.0;
  return scene;
}

TEST(Banner, NamesTheLastChangeAtOnceAndRestoresItsPreviousValue) {
  GuiFixture gui(stable_springs());
  run_and_stiffen(gui);
  EXPECT_NE(gui.text().find("k: 100 → 100,000 N/m"), std::string::npos) << gui.text();
  const std::string words = words_with_remedy(gui);
  EXPECT_NE(words.find("Undo k: 100 → 100,000 N/m, without which it does not diverge"), std::string::npos) << words;
  EXPECT_NE(words.find("Restore the previous value"), std::string::npos) << words;
  gui.frames(3);
  gui.click(gui.find("stopped", {"###restore"}));
  EXPECT_EQ(gui.status().snapshot->system->springs()[0].stiffness, 100.0);
  EXPECT_TRUE(gui.status().run.running);
  expect_to_run_through(gui, 2.0);
}

// The cheapest setting comes first; the second keeps the method, with its speed where that is slow.
TEST(Banner, OffersToKeepTheMethod) {
  GuiFixture gui(stable_springs());
  run_and_stiffen(gui);
  words_with_remedy(gui);
  gui.frames(3);
  gui.click(gui.find("stopped", {gui.text().find("Keep the method") == std::string::npos ? "###remedy" : "###same"}));
  EXPECT_EQ(gui.status().snapshot->settings.integrator, find_integrator("velocity_verlet"));
  EXPECT_GT(gui.status().snapshot->settings.substeps, 1);
  EXPECT_EQ(gui.status().snapshot->system->springs()[0].stiffness, 1e5);
  expect_to_run_through(gui, 2.0);
}

TEST(Banner, OffersToKeepTheMethodAtItsSpeedWhereThatIsTooSlowToBeTested) {
  GuiFixture gui(unstable_springs());
  run_until_it_stops(gui);
  const auto remedy = std::make_unique<Remedy>();
  remedy->cause = Remedy::Cause::StepTooLong;
  remedy->cheapest = TestedSetting{{find_integrator("baraff_witkin"), 1}, 1.0, 0.5, {}};
  remedy->untested = TestedSetting{{find_integrator("velocity_verlet"), 2156}, 0.03, 50.0, {}};
  for (int frame = 0; frame < 2; ++frame) {
    ImGui::NewFrame();
    PanelInput input = gui.app().panel_input({});
    input.results.remedy.found = *remedy;
    Requests requests;
    build_panels(input, gui.app().panels(), requests);
    ImGui::Render();
  }
  EXPECT_NE(read_text(*ImGui::GetDrawData()).find("Keep the method, 2156 substeps (0.02\u00d7 real time)"), std::string::npos);
}

// Also one that is too narrow for the search of the fixture.
glm::dvec2 find_small_button(GuiFixture& gui, const char* label) {
  const ImGuiWindow& window = *ImGui::FindWindowByName("stopped");
  const ImGuiID id = ImHashStr(label, 0, window.ID);
  for (double y = 4.0; y < window.Size.y; y += 8.0)
    for (double x = 4.0; x < window.Size.x; x += 16.0) {
      const glm::dvec2 at(window.Pos.x + x, window.Pos.y + y);
      gui.move(at);
      if (ImGui::GetCurrentContext()->HoveredId == id) return at;
    }
  return glm::dvec2(-1.0);
}

TEST(Banner, UndoesTheLastStepAndShowsWhereItFailed) {
  GuiFixture gui(stable_springs());
  run_and_stiffen(gui);
  words_with_remedy(gui);
  gui.frames(3);
  gui.click(find_small_button(gui, "###show"));
  EXPECT_FALSE(gui.app().selection().empty());
  EXPECT_TRUE(gui.app().marks().failed_point || gui.app().marks().failed_spring);
  // the camera flies there
  EXPECT_TRUE(gui.wait_until([&] { return gui.app().is_idle(); }));
  const Snapshot& now = *gui.status().snapshot;
  const Index failed = now.divergence->point
                           ? now.system->index_of(*now.divergence->point)
                           : now.system->index_of(now.system->springs()[now.system->index_of(*now.divergence->spring)].first);
  const glm::dvec2 seen = gui.seen(now.state.position[failed]);
  EXPECT_TRUE(gui.app().layout().scene.contains(seen.x, seen.y));
  gui.frames(3);
  const glm::dvec2 at = find_small_button(gui, "###undo");
  gui.click(at);
  EXPECT_EQ(gui.status().snapshot->system->springs()[0].stiffness, 100.0);
}

// Back to start keeps parameters that were changed during the run, and the remedy is tested with them.
TEST(Banner, AfterAnEditDuringTheRunContinuesFromTheLastGoodStateWithTheEditedParameters) {
  GuiFixture gui(stable_springs());
  run_and_stiffen(gui);
  const std::string words = words_with_remedy(gui);
  ASSERT_NE(words.find("Continue from t = "), std::string::npos) << words;
  EXPECT_NE(words.find("k: 100 → 100,000 N/m"), std::string::npos) << words;
  click_remedy(gui);
  EXPECT_EQ(gui.status().snapshot->system->springs()[0].stiffness, 1e5);
  expect_to_run_through(gui, 1.5);
}

TEST(Banner, StaysWhileParametersAreTunedUntilTheyResolveTheProblem) {
  GuiFixture gui(unstable_springs());
  run_until_it_stops(gui);
  const std::string message = "The simulation blew up at t = ";
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
