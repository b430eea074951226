// Lists of methods and forces, and the comparison of methods.
#include <gtest/gtest.h>

#include "scene/shape.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"
#include "support/two_springs.h"

namespace hooke {
namespace {

TEST(Forces, AreSwitchedSetAndRemovedInTheirPanel) {
  Scene scene = two_springs();
  scene.system.forces = {{find_force_term("wind"), false, default_values(*find_force_term("wind"))},
                         {find_force_term("buoyancy"), true, default_values(*find_force_term("buoyancy"))}};
  GuiFixture gui(scene);
  ImGui::GetIO().DisplaySize = {1280.0f, 2000.0f};
  gui.app().resize({1280.0, 2000.0}, 1.0);
  gui.frames(2);
  gui.frames(2);

  // the parameters of a force that is off are hidden
  EXPECT_LT(gui.find("side", {"wind 0", "x", "##value"}).x, 0.0);
  const glm::dvec2 box = gui.find("side", {"wind 0", "##on"});
  ASSERT_GT(box.x, 0.0);
  gui.click(box);
  EXPECT_TRUE(gui.system().forces[0].on);
  EXPECT_GT(gui.find("side", {"wind 0", "x", "##value"}).x, 0.0);

  const glm::dvec2 lift = gui.find("side", {"buoyancy 1", "lift", "##value"});
  gui.drag(lift, lift + glm::dvec2(500.0, 0.0));
  EXPECT_EQ(gui.system().forces[1].values[0], 2.0);
  gui.key(letter('Z'), {.control = true});
  EXPECT_EQ(gui.system().forces[1].values[0], 0.5);

  gui.click(gui.find("side", {"wind 0", "remove"}));
  ASSERT_EQ(gui.system().forces.size(), 1u);
  EXPECT_EQ(gui.system().forces[0].term, find_force_term("buoyancy"));
}

TEST(Forces, EachCanBeAddedFromTheList) {
  GuiFixture gui(two_springs());
  gui.resize({1280.0, 2000.0}, 1.0);
  gui.click(gui.find("side", {"Forces"}));  // expands the group
  for (const ForceTerm& term : force_terms()) {
    gui.click(gui.find("side", {"##add"}));
    gui.frames(2);
    gui.click(gui.find("##Combo_00", {term.label.data()}));
    ASSERT_EQ(gui.system().forces.size(), 1u) << term.id;
    EXPECT_EQ(gui.system().forces[0].term, &term);
    EXPECT_TRUE(gui.system().forces[0].on);
    gui.app().handle(Request(Action::Undo));
    gui.frames(2);
    ASSERT_TRUE(gui.system().forces.empty()) << term.id;
  }
}

TEST(Methods, EachCanBeChosenFromTheList) {
  GuiFixture gui(two_springs());
  gui.click(gui.find("side", {"##method"}));
  gui.frames(2);
  const std::string words = gui.text();
  for (const Integrator& method : integrators()) EXPECT_NE(words.find(method.label), std::string::npos) << method.label;
}

// The chart of cost against error is computed beside the window, and Cancel ends the work.
TEST(Comparison, RunsInTheBackgroundUntilCanceled) {
  GuiFixture gui(two_springs());
  gui.key(letter('M'), {.control = true, .shift = true});
  EXPECT_NE(gui.text().find("Compare methods on this scene"), std::string::npos);
  EXPECT_TRUE(gui.app().panel_input({}).results.comparison.is_running);
  EXPECT_FALSE(gui.app().is_idle());
  gui.click(gui.find("comparison", {"Cancel"}));
  EXPECT_TRUE(eventually_shows(gui, "Stopped."));
  EXPECT_FALSE(gui.app().panel_input({}).results.comparison.is_running);
  gui.frames(3);
  gui.click(gui.find("comparison", {"Close"}));
  EXPECT_EQ(gui.text().find("Compare methods on this scene"), std::string::npos);
}

// The fastest that keeps most of the motion, when the comparison is done.
TEST(Comparison, TheFastestStableMethodIsOneCommand) {
  GuiFixture gui(two_springs());
  gui.key(letter('F'), {.control = true, .shift = true});
  gui.click(gui.find("comparison", {"Cancel"}));
  ASSERT_TRUE(eventually_shows(gui, "Stopped."));
  gui.app().panels().shown.takes_fastest = true;

  MethodComparison done;
  const auto add = [&](const char* method, double error, double ms) {
    done.record.rows.push_back(
        {.method = method, .setting = {}, .step = 1.0 / 1200.0, .error = error, .relative_error = error, .cpu_ms_per_s = ms});
  };
  add("runge_kutta4", 1e-6, 9.0);
  add("symplectic_euler", 0.01, 2.0);
  add("xpbd", 0.5, 1.0);
  ImGui::NewFrame();
  PanelInput input = gui.app().panel_input({});
  input.results.comparison = {.result = std::make_shared<const MethodComparison>(done)};
  Requests requests;
  build_panels(input, gui.app().panels(), requests);
  ImGui::Render();
  for (const Request& request : requests) gui.app().handle(request);
  EXPECT_EQ(gui.status().snapshot->settings.integrator, find_integrator("symplectic_euler"));
  EXPECT_EQ(gui.status().snapshot->settings.substeps, 20);
  EXPECT_EQ(gui.app().panels().messages.toast, "Fastest stable method: Symplectic Euler, 20 substeps");
}

TEST(Times, AreShownByPhaseWithTheirHistory) {
  GuiFixture gui(two_springs());
  gui.key(letter('H'), {.control = true, .shift = true});
  gui.key(Key::Space);
  gui.frames(20);
  const std::string words = gui.text();
  for (const char* phase : {"Forces", "Contact", "Implicit solve", "Accuracy", "Auto", "Draw"})
    EXPECT_NE(words.find(phase), std::string::npos) << phase;
  EXPECT_GE(gui.app().panels().times.history[1].size(), 20u);
}

TEST(Comparison, ThePaletteFindsIt) {
  for (const char* word : {"compare", "error", "accuracy"}) {
    GuiFixture gui(two_springs());
    gui.key(letter('P'), {.control = true, .shift = true});
    gui.type(word);
    const std::string words = gui.text();
    const char* expected = std::string_view(word) == "accuracy" ? "Accuracy" : "Compare methods";
    EXPECT_NE(words.find(expected), std::string::npos) << word << ": " << words;
  }
}

}  // namespace
}  // namespace hooke
