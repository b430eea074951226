// The lines below sliders: limits and predictions.
#include <gtest/gtest.h>

#include <chrono>

#include "sim/methods/integrator.h"
#include "study/forecast.h"
#include "support/gui_sheets.h"
#include "support/two_springs.h"

namespace hooke {
namespace {

TEST(Stability, IsShownBelowTheSubstepsWithARecommendation) {
  Scene scene = two_springs();
  EXPECT_NE(GuiFixture(scene).text().find("(limit 2)"), std::string::npos);
  scene.settings.substeps = 1;
  for (Index s = 0; s < 2; ++s) scene.system.spring(s)->stiffness = 1e5;
  const double h = largest_stable_step(*scene.settings.integrator, bound_spectrum(scene.system));
  const auto needed = static_cast<int>(std::ceil(1.0 / (60.0 * h)));
  GuiFixture gui(scene);
  const std::string words = all_letters(*ImGui::GetDrawData());
  EXPECT_NE(words.find("linearlimit" + std::to_string(needed)), std::string::npos) << words;
  EXPECT_NE(words.find("recommended" + std::to_string(4 * needed) + "(4\u00d7)"), std::string::npos) << words;
}

// Its number is whole in a narrow panel too.
TEST(Stability, TheRecommendationFitsInANarrowPanel) {
  Scene scene = two_springs();
  scene.settings.substeps = 1;
  for (Index s = 0; s < 2; ++s) scene.system.spring(s)->stiffness = 1e8;
  GuiFixture gui(scene);
  gui.resize({700.0, 900.0}, 2.0);
  const std::string words = all_letters(*ImGui::GetDrawData());
  const std::size_t at = words.find("use");
  ASSERT_NE(at, std::string::npos) << words;
  EXPECT_NE(words.find("(4\u00d7)", at), std::string::npos) << words;
}

TEST(Stability, TheLimitOfContactFitsInThePanel) {
  Scene scene = two_springs();
  for (Index s = 0; s < 2; ++s) scene.system.spring(s)->stiffness = 1e8;
  scene.system.colliders = {{.shape = Plane{.point = {0.0, -5.0, 0.0}}}};
  scene.settings.integrator = find_integrator("implicit_euler");
  for (const int substeps : {900, 4000}) {
    scene.settings.substeps = substeps;
    GuiFixture gui(scene);
    const std::string words = all_letters(*ImGui::GetDrawData());
    const std::size_t at = words.find("\u03c9h=");
    ASSERT_NE(at, std::string::npos) << words;
    const std::size_t end = words.find(')', at);
    EXPECT_LT(end - at, 40u) << words.substr(at, 60);
    EXPECT_EQ(words.substr(at, end - at).find("..."), std::string::npos) << words.substr(at, 60);
  }
}

TEST(Predictions, AreShownBelowTheSlidersAndFollowThem) {
  // a mass of 1 kg on a spring of 100 N/m below a nail
  TestSim sim;
  const PointId nail = sim.nail(Vec3(0.0)), bob = sim.add({0.0, -0.5, 0.0});
  sim.join(nail, bob, 100.0, 0.5, 4.0);
  Scene scene = flat_scene("Bob", sim);
  scene.system.drag = 2.0;
  GuiFixture gui(scene);
  EXPECT_TRUE(eventually_shows(gui, "~ 98 mm"));
  // d / (2 sqrt(k m)), c / (2 omega) with omega = 10 and sqrt(g / l)
  EXPECT_TRUE(eventually_shows(gui, "0 slowest, 0.2 fastest"));
  EXPECT_TRUE(eventually_shows(gui, "0.25 slowest, 0.1 fastest"));
  EXPECT_NE(gui.text().find("step 0.833 ms"), std::string::npos);

  const glm::dvec2 slider = gui.find("side", {"gravity", "##value"});
  gui.drag(slider, slider + glm::dvec2(-500.0, 0.0));
  EXPECT_EQ(value_of(gui, "gravity"), 0.0);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (gui.text().find("98 mm") != std::string::npos) ASSERT_LT(std::chrono::steady_clock::now(), until);
  EXPECT_NE(gui.text().find("sag"), std::string::npos);
  EXPECT_NE(gui.text().find("0.2 fastest"), std::string::npos);
}

TEST(Predictions, ThatAreNotReadyOrDoNotExistHaveAReason) {
  const auto text_with = [](GuiFixture& gui, const Forecast& forecast) {
    ImGui::NewFrame();
    PanelInput input = gui.app().panel_input({});
    input.results.forecast = &forecast;
    Requests requests;
    build_panels(input, gui.app().panels(), requests);
    ImGui::Render();
    return read_text(*ImGui::GetDrawData());
  };
  GuiFixture gui(two_springs());
  EXPECT_NE(text_with(gui, {}).find("computing..."), std::string::npos);
  EXPECT_NE(
      text_with(gui, {.why_no_sag = "a part hangs on no nail", .system = gui.status().snapshot->system}).find("a part hangs on no nail"),
      std::string::npos);
  EXPECT_NE(text_with(gui, {.system = gui.status().snapshot->system}).find("no oscillation"), std::string::npos);
}

TEST(Predictions, AreHiddenWhereTheyDoNotApply) {
  for (const Scene& scene : {Scene{}, empty_scene()}) {
    GuiFixture gui(scene);
    gui.frames(20);
    EXPECT_EQ(gui.text().find("sag"), std::string::npos);
    EXPECT_EQ(gui.text().find("slowest"), std::string::npos);
  }
}

}  // namespace
}  // namespace hooke
