// The sliders and switches of the side panel: what they show and which edits they make.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "support/gui_sheets.h"
#include "support/two_springs.h"

namespace hooke {
namespace {

TEST(Sliders, EachParameterHasOne) {
  Scene scene = two_springs();
  scene.system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}}};
  scene.system.contact.points = true;
  std::vector<Spring> springs;
  for (const SpringFamily family : {SpringFamily::Structural, SpringFamily::Shear, SpringFamily::Bend}) {
    springs.push_back(scene.system.springs()[0]);
    springs.back().id = scene.system.new_spring_id();
    springs.back().family = family;
  }
  springs[0].law = SpringLaw{.amplitude = 0.1};
  scene.system.set_springs(springs);
  scene.sheet = std::make_shared<const SheetWeights>(SheetWeights{std::vector{0.1, 0.1, 0.1}, std::vector{0.75, 0.75, 0.375, 0.0, 0.75}});
  std::set<std::string_view> shown;
  for (int parameterization = 0; parameterization < 6; ++parameterization) {
    // the tolerance is of the automatic method, which needs no number of substeps; iterations are of methods that iterate
    scene.settings.integrator = parameterization == 4   ? &automatic_method()
                                : parameterization == 5 ? find_integrator("projective_dynamics")
                                                        : &default_integrator();
    scene.parameterization = static_cast<SpringParameterization>(parameterization % 4);
    GuiFixture gui(scene);
    ImGui::GetIO().DisplaySize = {1280.0f, 2300.0f};
    gui.app().resize({1280.0, 2300.0}, 1.0);
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

TEST(Sliders, ATypedNumberIsAppliedWhenFinishedAndRefusedOutOfRangeWithAMessage) {
  GuiFixture gui(two_springs());
  const glm::dvec2 slider = gui.find("side", {"stiffness", "##value"});
  gui.click(slider, Button::Left, {.control = true});
  gui.type("250");
  EXPECT_EQ(value_of(gui, "stiffness"), 100.0);
  gui.click({500.0, 600.0});
  gui.frames(2);
  EXPECT_EQ(value_of(gui, "stiffness"), 250.0);
  EXPECT_EQ(gui.app().panels().messages.toast, "");

  const auto type_substeps = [&](const char* number) {
    gui.click(gui.find("side", {"substeps", "##value"}), Button::Left, {.control = true});
    gui.type(number);
    gui.click({500.0, 600.0});
    gui.frames(2);
  };
  // as `--set` does, it accepts what a scene file may contain
  type_substeps("5000");
  EXPECT_EQ(value_of(gui, "substeps"), 5000.0);
  EXPECT_EQ(gui.app().panels().messages.toast, "");
  type_substeps("5000000");
  EXPECT_EQ(value_of(gui, "substeps"), 5000.0);
  EXPECT_EQ(gui.app().panels().messages.toast, "Substeps must be from 1 to 1,000,000; it is unchanged");
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
  scene.system.spring(0)->stiffness = 242.0;
  scene.system.spring(1)->stiffness = 125.0;
  return scene;
}

// The rectangle of the item under the cursor, which is at `from`.
std::pair<ImVec2, ImVec2> bounds_of_item(GuiFixture& gui, const glm::dvec2& from) {
  gui.move(from);
  const ImGuiID item = ImGui::GetCurrentContext()->HoveredId;
  const auto last = [&](const glm::dvec2& step) {
    glm::dvec2 at = from;
    do {
      at += step;
      gui.move(at);
    } while (ImGui::GetCurrentContext()->HoveredId == item);
    return at - step;
  };
  const glm::dvec2 top = last({0.0, -1.0}), bottom = last({0.0, 1.0}), left = last({-4.0, 0.0}), right = last({4.0, 0.0});
  return {{static_cast<float>(left.x - 4.0), static_cast<float>(top.y)}, {static_cast<float>(right.x + 4.0), static_cast<float>(bottom.y)}};
}

// The number of vertices of the handle at or above the lowest letter of a slider, where it is among the letters.
int handle_vertices_in_text(const ImDrawData& data, const std::pair<ImVec2, ImVec2>& slider) {
  const ImVec2 from = slider.first, to = slider.second;
  const auto is_inside = [&](const ImVec2& at) { return at.x >= from.x && at.x <= to.x && at.y >= from.y - 1.0f && at.y <= to.y + 2.0f; };
  const Glyphs glyphs = glyphs_by_texture();
  ImVec2 min{1e9f, 1e9f}, max{-1e9f, -1e9f};  // of the text
  std::vector<ImVec2> handle;
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const auto& vertices = data.CmdLists[n]->VtxBuffer;
    for (int i = 0; i < vertices.Size; ++i) {
      const ImDrawVert& vertex = vertices[i];
      if (!is_inside(vertex.pos)) continue;
      if (vertex.col == palette::accent) handle.push_back(vertex.pos);
      if (i + 2 >= vertices.Size || vertex.col != palette::text || !glyphs.contains({vertex.uv.x, vertex.uv.y})) continue;
      min = {std::min(min.x, vertex.pos.x), std::min(min.y, vertex.pos.y)};
      max = {std::max(max.x, vertices[i + 2].pos.x), std::max(max.y, vertices[i + 2].pos.y)};
    }
  }
  EXPECT_FALSE(handle.empty());
  EXPECT_LT(min.x, max.x);
  return static_cast<int>(std::ranges::count_if(handle, [&](const ImVec2& at) { return at.x > min.x && at.x < max.x && at.y <= max.y; }));
}

TEST(Sliders, DrawNoHandleAcrossTheirText) {
  std::optional<std::pair<ImVec2, ImVec2>> slider;
  for (double factor = 0.1; factor < 1000.0; factor *= 1.6) {
    Scene scene = uneven_springs();
    for (Index s = 0; s < 2; ++s) scene.system.spring(s)->stiffness *= factor;
    GuiFixture gui(scene);
    if (!slider) slider = bounds_of_item(gui, gui.find("side", {"stiffness", "##value"}));
    gui.move({600.0, 400.0});
    gui.frames(2);
    EXPECT_EQ(handle_vertices_in_text(*ImGui::GetDrawData(), *slider), 0) << factor;
  }
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
  scene.system.spring(0)->damping = 0.0;
  scene.system.spring(1)->damping = 3.0;
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
  scene.system.spring(1)->stiffness = 300.0;
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
  EXPECT_FALSE(gui.system().switches.dashpots);
  gui.click(box);
  EXPECT_TRUE(gui.system().switches.dashpots);
}

}  // namespace
}  // namespace hooke
