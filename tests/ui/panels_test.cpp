// The panels, run without a window: what they show and which requests they return.
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>

#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "scene/shape.h"
#include "sim/forces/force_term.h"
#include "sim/integrator.h"
#include "study/forecast.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"
#include "support/gui_sheets.h"

namespace hooke {
namespace {

Scene two_springs() {
  TestSim sim;
  const PointId a = sim.nail({-0.5, 0.0, 0.0}), b = sim.add({0.0, 0.0, 0.0}), c = sim.add({0.5, 0.0, 0.0});
  sim.join(a, b, 100.0, 0.5);
  sim.join(b, c, 100.0, 0.5);
  return flat_scene("Two springs", sim);
}

double value_of(GuiFixture& gui, std::string_view name) {
  const auto rows = parameters();
  const Status& status = gui.status();
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].name == name) return status.document->parameter_values[i];
  return -1.0;
}

TEST(Shortcuts, NoTwoRowsShareAKey) {
  std::set<std::string> seen;
  for (const Shortcut& row : shortcuts()) EXPECT_TRUE(seen.insert(key_text(row)).second) << key_text(row);
}

TEST(Shortcuts, EachRowIsFoundByItsKeyAndDescribed) {
  for (const Shortcut& row : shortcuts()) {
    EXPECT_EQ(find_shortcut(row.key, row.modifiers), &row) << key_text(row);
    EXPECT_FALSE(row.text.empty());
    EXPECT_FALSE(row.group.empty());
    // with other modifiers the key has another meaning or none
    EXPECT_NE(find_shortcut(row.key, {.control = !row.modifiers.control, .shift = row.modifiers.shift}), &row);
  }
}

TEST(Shortcuts, TheOverlayShowsEveryRow) {
  GuiFixture gui;
  EXPECT_EQ(gui.text().find("Ctrl+Shift+Z"), std::string::npos);
  gui.key(Key::F1);
  const std::string words = gui.text();
  for (const Shortcut& row : shortcuts()) {
    EXPECT_NE(words.find(key_text(row)), std::string::npos) << key_text(row);
    EXPECT_NE(words.find(row.text), std::string::npos) << row.text;
  }
  for (const MouseHint& hint : mouse_hints()) EXPECT_NE(words.find(hint.gesture), std::string::npos);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.text().find("Ctrl+Shift+Z"), std::string::npos);
}

TEST(Sliders, EachParameterHasOne) {
  Scene scene = two_springs();
  scene.system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}}};
  std::vector<Spring> springs;
  for (const SpringFamily family : {SpringFamily::Structural, SpringFamily::Shear, SpringFamily::Bend}) {
    springs.push_back(scene.system.springs()[0]);
    springs.back().id = scene.system.new_spring_id();
    springs.back().family = family;
  }
  scene.system.set_springs(springs);
  scene.sheet = std::make_shared<const SheetWeights>(SheetWeights{{0.1, 0.1, 0.1}, {0.75, 0.75, 0.375, 0.0, 0.75}});
  std::set<std::string_view> shown;
  for (int parameterization = 0; parameterization < 4; ++parameterization) {
    scene.parameterization = static_cast<SpringParameterization>(parameterization);
    GuiFixture gui(scene);
    ImGui::GetIO().DisplaySize = {1280.0f, 2000.0f};
    gui.app().resize({1280.0, 2000.0}, 1.0);
    gui.frames(2);
    gui.click(gui.find("side", {"Hand"}));  // expands the group
    gui.click(gui.find("side", {"Points"}));
    const std::set<ImGuiID> items = gui.items_in("side");
    for (const Parameter& row : parameters()) {
      const bool is_switch = row.kind == Parameter::Kind::Switch, is_choice = row.kind == Parameter::Kind::Choice;
      if (items.contains(GuiFixture::id_of("side", {row.name.data(), is_switch ? "##switch" : is_choice ? "##choice" : "##value"})))
        shown.insert(row.name);
    }
  }
  for (const Parameter& row : parameters()) EXPECT_TRUE(shown.contains(row.name)) << row.name;
}

TEST(Sliders, OfFamiliesThatTheSceneLacksAreHidden) {
  GuiFixture gui(two_springs());
  EXPECT_NE(gui.text().find("Stiffness k"), std::string::npos);
  EXPECT_EQ(gui.text().find("Shear"), std::string::npos);
}

TEST(Sliders, ADragIsOneUndoStep) {
  GuiFixture gui(two_springs());
  const glm::dvec2 slider = gui.find("side", {"substeps", "##value"});
  ASSERT_GT(slider.x, 0.0);
  gui.drag(slider, slider + glm::dvec2(-60.0, 0.0));
  const double dragged = value_of(gui, "substeps");
  EXPECT_LT(dragged, 200.0);
  gui.drag(slider, slider + glm::dvec2(40.0, 0.0));
  EXPECT_GT(value_of(gui, "substeps"), dragged);
  gui.key(letter('Z'), {.control = true});
  EXPECT_EQ(value_of(gui, "substeps"), dragged);
  gui.key(letter('Z'), {.control = true});
  EXPECT_EQ(value_of(gui, "substeps"), 20.0);
}

TEST(Sliders, RightClickRestoresTheDefault) {
  GuiFixture gui(two_springs());
  const glm::dvec2 slider = gui.find("side", {"gravity", "##value"});
  gui.drag(slider, slider + glm::dvec2(-500.0, 0.0));
  EXPECT_EQ(value_of(gui, "gravity"), 0.0);
  gui.click(slider, Button::Right);
  EXPECT_NEAR(value_of(gui, "gravity"), 9.81, 1e-12);
}

TEST(Sliders, ATypedNumberIsAppliedWhenFinishedAndClampedWithAMessage) {
  GuiFixture gui(two_springs());
  const glm::dvec2 slider = gui.find("side", {"stiffness", "##value"});
  gui.click(slider, Button::Left, {.control = true});
  gui.type("250");
  EXPECT_EQ(value_of(gui, "stiffness"), 100.0);
  gui.click({500.0, 600.0});
  gui.frames(2);
  EXPECT_EQ(value_of(gui, "stiffness"), 250.0);
  EXPECT_EQ(gui.app().panels().toast, "");

  gui.click(gui.find("side", {"substeps", "##value"}), Button::Left, {.control = true});
  gui.type("5000");
  gui.click({500.0, 600.0});
  gui.frames(2);
  EXPECT_EQ(value_of(gui, "substeps"), 1000.0);
  EXPECT_EQ(gui.app().panels().toast, "Substeps must be between 1 and 1000 ");
}

TEST(Sliders, StiffnessAppliesToTheSelectionIfThereIsOne) {
  GuiFixture gui(two_springs());
  gui.key(letter('V'));
  const Layout& layout = gui.app().layout();
  // between the second and the third point
  const Vec3 middle = gui.app().camera().project({0.25, 0.0, 0.0}, {layout.scene.width, layout.scene.height});
  gui.click({layout.scene.x + middle.x, layout.scene.y + middle.y});
  ASSERT_EQ(gui.app().selection().springs.size(), 1u);
  EXPECT_NE(gui.text().find("Stiffness k"), std::string::npos);
  const glm::dvec2 slider = gui.find("side", {"stiffness", "##value"});
  gui.drag(slider, slider + glm::dvec2(-300.0, 0.0));
  EXPECT_EQ(gui.system().springs()[0].stiffness, 100.0);
  EXPECT_EQ(gui.system().springs()[1].stiffness, 0.01);
}

Scene uneven_springs() {
  Scene scene = two_springs();
  scene.system.spring(0).stiffness = 242.0;
  scene.system.spring(1).stiffness = 125.0;
  return scene;
}

TEST(Sliders, ScaleDifferentValuesByOneFactor) {
  GuiFixture gui(uneven_springs());
  EXPECT_NE(gui.text().find("varies, ~184 N/m"), std::string::npos) << gui.text();
  const auto k = [&](Index s) { return gui.system().springs()[s].stiffness; };
  const glm::dvec2 slider = gui.find("side", {"stiffness", "##value"});
  gui.drag(slider, slider + glm::dvec2(30.0, 0.0));
  EXPECT_GT(k(0), 300.0);
  EXPECT_NEAR(k(0) / k(1), 242.0 / 125.0, 1e-9);
  gui.key(letter('Z'), {.control = true});
  EXPECT_EQ(k(0), 242.0);
  EXPECT_EQ(k(1), 125.0);
  // a visit to the end of the slider loses nothing
  gui.move(slider);
  gui.press();
  gui.move(slider + glm::dvec2(-500.0, 0.0));
  gui.move(slider + glm::dvec2(10.0, 0.0));
  gui.release();
  EXPECT_NEAR(k(0) / k(1), 242.0 / 125.0, 1e-9);
  // typing makes them equal
  gui.click(slider, Button::Left, {.control = true});
  gui.type("250");
  gui.click({500.0, 600.0});
  gui.frames(2);
  EXPECT_EQ(k(0), 250.0);
  EXPECT_EQ(k(1), 250.0);
}

TEST(Sliders, ScaleDampingWithZerosAndFrictionWithinItsRange) {
  Scene scene = two_springs();
  scene.system.spring(0).damping = 0.0;
  scene.system.spring(1).damping = 3.0;
  const Plane floor{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}};
  scene.system.colliders = {{.shape = floor, .friction = 0.2}, {.shape = floor, .friction = 0.8}};
  GuiFixture gui(scene);
  gui.resize({1280.0, 2000.0}, 1.0);
  glm::dvec2 slider = gui.find("side", {"damping", "##value"});
  gui.drag(slider, slider + glm::dvec2(30.0, 0.0));
  EXPECT_EQ(gui.system().springs()[0].damping, 0.0);
  EXPECT_NE(gui.system().springs()[1].damping, 3.0);
  EXPECT_GT(gui.system().springs()[1].damping, 0.0);
  slider = gui.find("side", {"friction", "##value"});
  gui.drag(slider, slider + glm::dvec2(-25.0, 0.0));
  const auto& colliders = gui.system().colliders;
  EXPECT_NEAR(colliders[1].friction / colliders[0].friction, 4.0, 1e-9);
  EXPECT_NE(colliders[0].friction, 0.2);
}

TEST(Sliders, TheHandleNeverCrossesTheDigits) {
  Scene scene = two_springs();
  scene.system.spring(1).stiffness = 300.0;
  GuiFixture gui(scene);
  for (double value = 0.02; value < 1e6; value *= 1.35) {
    gui.app().handle(Request(Edit{SetSpringProperty{SpringProperty::Stiffness, {{SpringId{0}, value}}}}));
    gui.app().handle(Request(Edit{SetParameter{find_parameter("substeps"), std::min(1000.0, std::ceil(value))}}));
    gui.frame();
    EXPECT_EQ(crossed_text(*ImGui::GetDrawData(), palette::accent), std::set<std::string>()) << value;
  }
}

// Hints of all lengths stay on their line.
TEST(Sliders, StayInPlaceWhileTheSceneRunsAndIsEdited) {
  GuiFixture gui(two_springs());
  const auto place = [&] { return gui.find("side", {"gravity", "##value"}); };
  const glm::dvec2 before = place();
  gui.key(Key::Space);
  gui.frames(60);
  EXPECT_EQ(place(), before);
  gui.app().handle(Request(Edit{RestoreParameter{find_parameter("stiffness"), 1e5}}));
  gui.frames(2);
  EXPECT_EQ(place(), before);
  gui.frames(60);
  EXPECT_EQ(place(), before);
  gui.app().handle(Request(Edit{SetParameter{find_parameter("damping"), 1e4}}));
  gui.app().handle(Request(Edit{SetParameter{find_parameter("substeps"), 1.0}}));
  gui.frames(60);
  EXPECT_EQ(place(), before);
}

TEST(Sliders, JumpToAClickOnlyNearTheHandle) {
  GuiFixture gui(two_springs());
  const glm::dvec2 slider = gui.find("side", {"gravity", "##value"});
  const double before = value_of(gui, "gravity");
  const double end = gui.app().layout().side.x + gui.app().layout().side.width - 34.0;
  gui.click({end, slider.y});
  EXPECT_EQ(value_of(gui, "gravity"), before);
  gui.drag({end - 20.0, slider.y}, {end, slider.y});
  const double dragged = value_of(gui, "gravity");
  EXPECT_GT(dragged, 25.0);
  // a few pixels beside the handle
  gui.click({end - 8.0, slider.y});
  EXPECT_LT(value_of(gui, "gravity"), dragged);
}

TEST(Sliders, StiffnessFollowsTheStepsOfTheScene) {
  Scene scene = two_springs();
  scene.controls = {0.1, 10.0, 0.1};
  GuiFixture gui(scene);
  const glm::dvec2 slider = gui.find("side", {"stiffness", "##value"});
  gui.drag(slider, slider + glm::dvec2(-30.0, 0.0));
  const double k = gui.system().springs()[0].stiffness;
  EXPECT_GT(k, 0.1);
  EXPECT_LT(k, 10.0);
  EXPECT_NEAR(10.0 * k, std::round(10.0 * k), 1e-9);
}

TEST(Switches, TurnDashpotsOffAndOn) {
  GuiFixture gui(two_springs());
  const glm::dvec2 box = gui.find("side", {"damped_springs", "##switch"});
  gui.click(box);
  EXPECT_FALSE(gui.system().dashpots_on);
  gui.click(box);
  EXPECT_TRUE(gui.system().dashpots_on);
}

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
  for (const ForceTerm& term : force_terms()) {
    GuiFixture gui(two_springs());
    ImGui::GetIO().DisplaySize = {1280.0f, 2000.0f};
    gui.app().resize({1280.0, 2000.0}, 1.0);
    gui.frames(2);
    gui.frames(2);
    gui.click(gui.find("side", {"Forces"}));  // expands the group
    gui.click(gui.find("side", {"##add"}));
    gui.frames(2);
    gui.click(gui.find("##Combo_00", {term.label.data()}));
    ASSERT_EQ(gui.system().forces.size(), 1u) << term.id;
    EXPECT_EQ(gui.system().forces[0].term, &term);
    EXPECT_TRUE(gui.system().forces[0].on);
  }
}

TEST(Methods, EachCanBeChosenFromTheList) {
  GuiFixture gui(two_springs());
  gui.click(gui.find("side", {"##method"}));
  gui.frames(2);
  const std::string words = gui.text();
  for (const Integrator& method : integrators()) EXPECT_NE(words.find(method.label), std::string::npos) << method.label;
}

// Predictions are computed in another thread and appear when they are ready.
bool eventually_shows(GuiFixture& gui, const char* words) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (gui.text().find(words) == std::string::npos)
    if (std::chrono::steady_clock::now() > until) return false;
  return true;
}

// The chart of cost against error is computed beside the window, and Cancel ends the work.
TEST(Comparison, RunsInTheBackgroundUntilCanceled) {
  GuiFixture gui(two_springs());
  gui.key(letter('M'), {.control = true, .shift = true});
  EXPECT_NE(gui.text().find("Compare methods on this scene"), std::string::npos);
  EXPECT_TRUE(gui.app().panel_input({}).comparison.is_running);
  EXPECT_FALSE(gui.app().is_idle());
  gui.click(gui.find("comparison", {"Cancel"}));
  EXPECT_TRUE(eventually_shows(gui, "Stopped."));
  EXPECT_FALSE(gui.app().panel_input({}).comparison.is_running);
  gui.click(gui.find("comparison", {"Close"}));
  EXPECT_EQ(gui.text().find("Compare methods on this scene"), std::string::npos);
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

TEST(Lists, AreClosedByEsc) {
  const auto is_open = [] { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel); };
  GuiFixture gui(two_springs());
  for (const std::initializer_list<const char*> list : {std::initializer_list<const char*>{"##method"}, {"dimensions", "##choice"}}) {
    gui.click(gui.find("side", list));
    gui.frames(2);
    EXPECT_TRUE(is_open());
    gui.key(Key::Escape);
    EXPECT_FALSE(is_open());
  }
  gui.app().handle(Request(StartPlacement{find_shape_kind("hanging_rope")}));
  gui.frames(2);
  gui.click(gui.find("placing", {"##held"}));
  gui.frames(2);
  EXPECT_TRUE(is_open());
  gui.key(Key::Escape);
  EXPECT_FALSE(is_open());
  EXPECT_TRUE(gui.app().panels().placement.is_on());
}

TEST(Stability, IsShownBelowTheSubstepsWithARecommendation) {
  Scene scene = two_springs();
  EXPECT_NE(GuiFixture(scene).text().find("(limit 2)"), std::string::npos);
  scene.settings.substeps = 1;
  for (Index s = 0; s < 2; ++s) scene.system.spring(s).stiffness = 1e5;
  const double h = largest_stable_step(*scene.settings.integrator, bound_spectrum(scene.system));
  const auto needed = static_cast<int>(std::ceil(1.0 / (60.0 * h)));
  EXPECT_NE(GuiFixture(scene).text().find("min " + std::to_string(needed) + " substeps"), std::string::npos);
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
    input.forecast = &forecast;
    Requests requests;
    build_panels(input, gui.app().panels(), requests);
    ImGui::Render();
    return read_text(*ImGui::GetDrawData());
  };
  GuiFixture gui(two_springs());
  EXPECT_NE(text_with(gui, {}).find("computing..."), std::string::npos);
  EXPECT_NE(text_with(gui, {.why_no_sag = "nothing holds it", .system = gui.status().snapshot->system}).find("nothing holds it"),
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

TEST(ToolBar, AClickSelectsTheToolAndItsNextStepIsShown) {
  GuiFixture gui(two_springs());
  for (const ToolRow& row : tools()) {
    const int action = static_cast<int>(row.action);
    // an item by number, found by its position in the bar
    const Rect& bar = gui.app().layout().tools;
    const double index = static_cast<double>(&row - tools().data());
    gui.click({bar.x + 0.5 * bar.width, bar.y + 30.0 + 58.0 * index});
    EXPECT_EQ(gui.app().tool(), row.action) << action;
    EXPECT_NE(gui.text().find(shortcut_of(row.action).text), std::string::npos);
  }
}

TEST(Menus, OpenUnderTheirNamesAndCloseOnEsc) {
  GuiFixture gui(two_springs());
  gui.click(gui.find("menu", {"Scenes"}));
  gui.frames(3);
  EXPECT_NE(gui.text().find("Cloth on a ball"), std::string::npos);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.text().find("Cloth on a ball"), std::string::npos);
}

TEST(Menus, ShowWhatUndoWillUndo) {
  GuiFixture gui(two_springs());
  gui.key(letter('R'));
  gui.click(gui.find("menu", {"Edit"}));
  gui.frames(3);
  EXPECT_NE(gui.text().find("Undo: release 1 point"), std::string::npos);
}

// Builds frames until the search for a remedy is over.
std::string words_with_remedy(GuiFixture& gui) {
  for (int i = 0; i < 6000; ++i) {
    const std::string words = gui.text();
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

TEST(Legend, ShowsTheStrainsOfItsColors) {
  GuiFixture gui(two_springs());
  EXPECT_NE(gui.text().find("Strain"), std::string::npos);
  EXPECT_NE(gui.text().find("+0.01 %"), std::string::npos);
  gui.app().panels().view.strain_colors = false;
  EXPECT_EQ(gui.text().find("+0.01 %"), std::string::npos);
}

TEST(Legend, ShowsNoRoundOff) {
  Scene scene = two_springs();
  scene.state.position[2].x = 0.5 + 1e-16;
  scene.system.spring(0).rest_length = 0.1 + 0.2 + 0.2;
  scene.system.spring(1).rest_length = std::nextafter(0.5, 1.0);
  GuiFixture gui(scene);
  EXPECT_NE(gui.text().find("0 % to 0 %"), std::string::npos) << gui.text();
}

TEST(SidePanel, OfAnotherSceneIsReadFromItsTop) {
  GuiFixture gui(two_springs());
  gui.resize({1280.0, 500.0}, 1.0);
  ImGuiWindow& side = *ImGui::FindWindowByName("side");
  side.ScrollTarget.y = 0.5f * side.ScrollMax.y;
  gui.frames(2);
  ASSERT_GT(side.Scroll.y, 0.0f);
  gui.app().handle(Request(OpenFile{find_scene("rope")}));
  gui.frames(3);
  EXPECT_EQ(gui.app().title(), "Hooke - Rope");
  EXPECT_EQ(side.Scroll.y, 0.0f);
}

TEST(EmptyScene, ShowsInstructions) {
  EXPECT_NE(GuiFixture(Scene{}).text().find("Press A and click to add points"), std::string::npos);
  EXPECT_EQ(GuiFixture(two_springs()).text().find("Press A and click to add points"), std::string::npos);
}

}  // namespace
}  // namespace hooke
