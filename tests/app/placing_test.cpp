// Shapes and meshes have a preview before they are placed; placing is one undo step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

#include "formats/open_file.h"
#include "scene/shape.h"
#include "support/gui_fixture.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

Scene is_3d_only() {
  Scene scene = empty_scene();
  scene.system.dimensions = 3;
  return scene;
}

Placement& choose(GuiFixture& gui, std::string_view id) {
  gui.app().handle(Request(StartPlacement{find_shape_kind(id)}));
  gui.frames(2);
  return gui.app().panels().placement;
}

TEST(Placement, TheMenuOffersEveryShapeOfTheTable) {
  GuiFixture gui(is_3d_only());
  gui.click(gui.find("menu", {"Add"}));
  gui.frames(3);
  const std::string words = gui.text();
  for (const ShapeKind& kind : placeable_shapes()) EXPECT_NE(words.find(kind.label), std::string::npos) << kind.label;
  EXPECT_NE(words.find("From a mesh"), std::string::npos);
}

TEST(Placement, ThePanelHasAFieldForEveryParameter) {
  for (const ShapeKind& kind : placeable_shapes()) {
    GuiFixture gui(is_3d_only());
    choose(gui, kind.id);
    const std::string words = gui.text();
    for (const ShapeNumber& number : kind.numbers) EXPECT_NE(words.find(number.label), std::string::npos) << kind.id << ' ' << number.label;
  }
}

TEST(Placement, ThePreviewShowsTheResultAndChangesNothing) {
  GuiFixture gui(is_3d_only());
  Placement& placement = choose(gui, "sheet");
  EXPECT_EQ(gui.app().marks().ghost_lines.size(), element_count_of(placement.shape).springs);
  EXPECT_EQ(gui.app().marks().ghost_nails.size(), 2u);
  EXPECT_EQ(gui.system().point_count(), 0);
  EXPECT_FALSE(gui.status().history.unsaved);
  // in sight beside the dialog, and above the floor
  const glm::dvec2 at = gui.seen(placement.shape.at);
  const Rect& view = gui.app().layout().scene;
  EXPECT_GT(at.x, view.x + 324.0);
  EXPECT_LT(at.x, view.x + view.width);
  for (const auto& [from, to] : gui.app().marks().ghost_lines) EXPECT_GT(std::min(from.y, to.y), -1.0);
}

// Without the choice of another view, the one before comes back.
TEST(Placement, ItsPanelTakesThePlaceOfTheOthersAtTheLeft) {
  GuiFixture gui(is_3d_only());
  gui.key(letter('H'), {.control = true, .shift = true});
  EXPECT_TRUE(gui.app().panels().times.is_shown);
  EXPECT_TRUE(choose(gui, "sheet").is_on());
  EXPECT_FALSE(gui.app().panels().times.is_shown);
  gui.key(letter('H'), {.control = true, .shift = true});
  EXPECT_TRUE(gui.app().panels().times.is_shown);
  EXPECT_FALSE(gui.app().panels().placement.is_on());
}

TEST(Placement, OfALargePartIsSeenFromFartherAway) {
  for (const bool is_placed : {false, true}) {
    GuiFixture gui(is_3d_only());
    gui.resize({700.0, 450.0}, 1.0);
    const double before = gui.app().camera().distance;
    choose(gui, "bridge");
    const double during = gui.app().camera().distance;
    EXPECT_GT(during, before);
    const Rect& view = gui.app().layout().scene;
    for (const auto& [from, to] : gui.app().marks().ghost_lines)
      for (const Vec3& end : {from, to}) EXPECT_TRUE(view.contains(gui.seen(end).x, gui.seen(end).y));
    gui.key(is_placed ? Key::Enter : Key::Escape);
    EXPECT_EQ(gui.app().camera().distance, is_placed ? during : before);
  }
}

TEST(Placement, StartsOutsideColliders) {
  Scene scene = is_3d_only();
  scene.system.colliders.push_back({.shape = Sphere{{0.4, 0.0, 0.0}, 0.7}});
  for (const ShapeKind& kind : placeable_shapes()) {
    GuiFixture gui(scene);
    choose(gui, kind.id);
    for (const auto& [from, to] : gui.app().marks().ghost_lines) {
      EXPECT_GT(std::min(from.y, to.y), -1.0) << kind.id;
      EXPECT_GE(glm::distance(from, Vec3(0.4, 0.0, 0.0)), 0.7) << kind.id;
    }
  }
}

TEST(Placement, ThePreviewFollowsASliderAtOnce) {
  GuiFixture gui(is_3d_only());
  Placement& placement = choose(gui, "hanging_rope");
  const glm::dvec2 slider = gui.find("placing/rows", {"points", "##value"});
  ASSERT_GT(slider.x, 0.0);
  const std::size_t before = gui.app().marks().ghost_lines.size();
  gui.drag(slider, slider + glm::dvec2(40.0, 0.0));
  EXPECT_GT(gui.app().marks().ghost_lines.size(), before);
  EXPECT_EQ(gui.app().marks().ghost_lines.size(), element_count_of(placement.shape).springs);
}

TEST(Placement, EnterPlacesItAsOneUndoStep) {
  GuiFixture gui(is_3d_only());
  const ElementCount element_count = element_count_of(choose(gui, "jelly").shape);
  gui.key(Key::Enter);
  EXPECT_EQ(gui.system().points().size(), element_count.points);
  EXPECT_EQ(gui.system().springs().size(), element_count.springs);
  EXPECT_EQ(gui.system().faces.size(), element_count.faces);
  EXPECT_FALSE(gui.app().panels().placement.is_on());
  gui.key(letter('Z'), {.control = true});
  EXPECT_EQ(gui.system().point_count(), 0);
  gui.key(letter('Z'), {.control = true, .shift = true});
  EXPECT_EQ(gui.system().points().size(), element_count.points);
}

// Cloths and ropes touch where users expect it; undo removes the contact with the part.
// Until a large part is there, its preview stays, and a line says so; the hint of an empty scene does not cover it.
TEST(Placement, OfALargePartIsFollowed) {
  GuiFixture gui(is_3d_only());
  Placement& placement = choose(gui, "sheet");
  for (std::size_t i = 0; i < placement.shape.kind->numbers.size(); ++i)
    if (const std::string_view label = placement.shape.kind->numbers[i].label; label == "Columns" || label == "Rows")
      placement.shape.values[i] = 150.0;
  gui.frames(2);
  gui.app().handle(KeyPress{Key::Enter});
  ImGui::NewFrame();
  gui.app().build_frame({});
  ImGui::Render();
  EXPECT_EQ(gui.app().panels().messages.toast, "Placing 22,500 points...");
  EXPECT_FALSE(gui.app().marks().ghost_lines.empty());
  EXPECT_EQ(read_text(*ImGui::GetDrawData()).find("Press A"), std::string::npos);
  gui.frames(2);
  EXPECT_EQ(gui.system().point_count(), 22'500);
  EXPECT_TRUE(gui.app().marks().ghost_lines.empty());
}

TEST(Placement, SwitchesOnContactInTheSameStep) {
  for (const ShapeKind& kind : placeable_shapes()) {
    GuiFixture gui(is_3d_only());
    choose(gui, kind.id);
    gui.key(Key::Enter);
    const PairContact placed = gui.system().contact;
    EXPECT_EQ(placed.faces && placed.springs, kind.id != "bridge") << kind.id;
    EXPECT_FALSE(placed.points) << kind.id;
    if (placed.faces) {
      EXPECT_GT(placed.thickness, 1e-3) << kind.id;
      EXPECT_LE(placed.thickness, 0.02) << kind.id;
    }
    gui.key(letter('Z'), {.control = true});
    EXPECT_EQ(gui.system().point_count(), 0) << kind.id;
    EXPECT_EQ(gui.system().contact, PairContact{}) << kind.id;
    gui.key(letter('Z'), {.control = true, .shift = true});
    EXPECT_GT(gui.system().point_count(), 0) << kind.id;
    EXPECT_EQ(gui.system().contact, placed) << kind.id;
  }
}

TEST(Placement, KeepsTheContactOfASceneThatHasOne) {
  for (const PairContact& contact :
       {PairContact{.points = true}, PairContact{.faces = true, .thickness = 0.003}, PairContact{.friction = 0.1}}) {
    Scene scene = is_3d_only();
    scene.system.contact = contact;
    GuiFixture gui(scene);
    choose(gui, "sheet");
    gui.key(Key::Enter);
    EXPECT_EQ(gui.system().contact, contact);
    gui.key(letter('Z'), {.control = true});
    EXPECT_EQ(gui.system().contact, contact);
  }
}

TEST(Placement, OfARopeInAFlatSceneSwitchesOnContactOfSprings) {
  for (const auto& [id, touches] : {std::pair{"hanging_rope", true}, {"sheet", false}}) {
    GuiFixture gui(empty_scene());
    choose(gui, id);
    gui.key(Key::Enter);
    EXPECT_EQ(gui.system().contact.springs, touches) << id;
    EXPECT_FALSE(gui.system().contact.faces) << id;
  }
}

// A solid is built with angles between its faces, wherever and however it is placed.
TEST(Placement, FacesHaveTheAnglesAtWhichTheyArePlaced) {
  GuiFixture gui(is_3d_only());
  choose(gui, "jelly").shape.tilt = 30.0;
  gui.key(Key::Enter);
  double largest = 0.0;
  for (const Face& face : gui.system().faces)
    for (const double angle : face.rest_angle) largest = std::max(largest, std::abs(angle));
  EXPECT_NEAR(largest, std::acos(0.0), 1e-9);
}

TEST(Placement, EveryShapeIsInsertedAsGenerated) {
  for (const ShapeKind& kind : placeable_shapes()) {
    GuiFixture gui(is_3d_only());
    const ElementCount element_count = element_count_of(choose(gui, kind.id).shape);
    gui.key(Key::Enter);
    EXPECT_EQ(gui.system().points().size(), element_count.points) << kind.id;
    EXPECT_EQ(gui.system().springs().size(), element_count.springs) << kind.id;
  }
}

TEST(Placement, AClothHasTheSameMaterialAsInAFile) {
  for (const char* id : {"sheet", "curtain", "flag", "net"}) {
    GuiFixture gui(is_3d_only());
    const Shape shape = choose(gui, id).shape;
    gui.key(Key::Enter);
    Network network;
    generate(shape, network);
    const auto& sheet = gui.status().document->sheet;
    ASSERT_NE(sheet, nullptr) << id;
    for (Index i = 0; i < gui.system().point_count(); ++i)
      EXPECT_EQ(sheet->area_of(gui.system().points()[i].id),
                static_cast<std::size_t>(i) < network.sheet_areas.size() ? network.sheet_areas[i] : 0.0);
    for (Index s = 0; s < gui.system().spring_count(); ++s)
      EXPECT_EQ(sheet->sheet_weight_of(gui.system().springs()[s].id),
                static_cast<std::size_t>(s) < network.sheet_weights.size() ? network.sheet_weights[s] : 0.0);
  }
  GuiFixture gui(is_3d_only());
  choose(gui, "bridge");
  gui.key(Key::Enter);
  EXPECT_EQ(gui.status().document->sheet, nullptr);
}

// Points that are released show the color of their shape.
TEST(Placement, ColorsNailedPointsToo) {
  Shape shape = default_shape(*find_shape_kind("hanging_rope"));
  shape.color = Color{91, 192, 176};
  Network network;
  generate(shape, network);
  ASSERT_TRUE(network.points.front().nailed);
  for (const Point& point : network.points) EXPECT_EQ(point.color, shape.color);
}

TEST(Placement, EscLeavesTheSceneUnchanged) {
  GuiFixture gui(is_3d_only());
  choose(gui, "net");
  gui.key(Key::Escape);
  EXPECT_FALSE(gui.app().panels().placement.is_on());
  EXPECT_TRUE(gui.app().marks().ghost_lines.empty());
  EXPECT_EQ(gui.system().point_count(), 0);
}

TEST(Placement, AClickInTheSceneMovesItThereInsteadOfUsingTheTool) {
  GuiFixture gui(is_3d_only());
  gui.key(letter('A'));
  Placement& placement = choose(gui, "net");
  const Layout& layout = gui.app().layout();
  const glm::dvec2 to(layout.scene.x + 0.7 * layout.scene.width, layout.scene.y + 0.6 * layout.scene.height);
  gui.click(to);
  EXPECT_EQ(gui.system().point_count(), 0) << "the Add tool is active";
  const Vec3 seen = gui.app().camera().project(placement.shape.at, {layout.scene.width, layout.scene.height});
  EXPECT_NEAR(seen.x, 0.7 * layout.scene.width, 1.0);
  EXPECT_NEAR(seen.y, 0.6 * layout.scene.height, 1.0);
}

TEST(Placement, InAFlatSceneIsFlat) {
  Scene flat = empty_scene();
  flat.system.dimensions = 2;
  GuiFixture gui(flat);
  choose(gui, "bridge").shape.tilt = 30.0;
  gui.key(Key::Enter);
  EXPECT_EQ(gui.system().points().size(), 21u) << "a truss without width";
  for (const Vec3& place : gui.status().snapshot->state.position) EXPECT_EQ(place.z, 0.0);
}

TEST(Placement, IsUprightForAnyUpDirection) {
  Scene scene = is_3d_only();
  scene.system.gravity = {0.0, 0.0, -9.81};
  GuiFixture gui(scene);
  Placement& placement = choose(gui, "sheet");
  gui.key(Key::Enter);
  const auto& places = gui.status().snapshot->state.position;
  EXPECT_NEAR(places.front().z - places.back().z, 1.0, 1e-9) << "its first row is its upper edge";
  EXPECT_FALSE(placement.is_on());
}

TEST(Placement, AMeshIsPlacedAtTheRequestedSize) {
  ScratchFolder scratch;
  std::ofstream(scratch.folder / "square.obj") << "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nf 1 2 3 4\n";
  GuiFixture gui(is_3d_only());
  Placement& placement = gui.app().panels().placement;
  gui.app().handle(Request(StartPlacement{nullptr}));
  placement.mesh_size = 3.0;
  placement.mesh_path = (scratch.folder / "square.obj").string();
  gui.app().handle(Request(LoadMesh{placement.mesh_path}));
  gui.frames(2);
  EXPECT_EQ(gui.app().marks().ghost_lines.size(), 6u);
  gui.key(Key::Enter);
  const auto& places = gui.status().snapshot->state.position;
  ASSERT_EQ(places.size(), 4u);
  EXPECT_NEAR(glm::length(places[1] - places[0]), 3.0, 1e-12);
  for (const Point& point : gui.system().points()) EXPECT_NEAR(gui.status().document->sheet->area_of(point.id), 3.0 * 1.5 / 4.0, 1e-12);
  for (const Spring& spring : gui.system().springs()) {
    const Vec3 offset = places[static_cast<std::size_t>(gui.system().index_of(spring.second))] -
                        places[static_cast<std::size_t>(gui.system().index_of(spring.first))];
    EXPECT_NEAR(glm::length(offset), spring.rest_length, 1e-12);
  }
}

TEST(Placement, AMeshHasItsOwnMaterial) {
  ScratchFolder scratch;
  std::ofstream(scratch.folder / "square.obj") << "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nf 1 2 3 4\n";
  GuiFixture gui(is_3d_only());
  gui.app().handle(Request(StartPlacement{nullptr}));
  gui.frames(2);
  // nothing to place yet, and the button gives the reason
  EXPECT_NE(gui.text().find("No mesh yet"), std::string::npos);
  EXPECT_NE(gui.text().find("Browse..."), std::string::npos);
  gui.app().handle(Request(LoadMesh{scratch.folder / "square.obj"}));
  gui.frames(2);
  Placement& placement = gui.app().panels().placement;
  placement.mesh_density = 2.0;
  placement.mesh_stiffness = 500.0;
  placement.mesh_damping = 0.3;
  gui.key(Key::Enter);
  double mass = 0.0;
  for (const Point& point : gui.system().points()) mass += point.mass;
  EXPECT_NEAR(mass, 2.0 * 1.0 * 0.5, 1e-12);
  for (const Spring& spring : gui.system().springs()) EXPECT_NEAR(spring.damping / spring.stiffness, 0.3 / 500.0, 1e-12);
  // it looks as if the file had been opened
  const Scene opened = load_file(scratch.folder / "square.obj").scene;
  EXPECT_EQ(gui.app().panels().view.points, opened.view.points);
  EXPECT_EQ(gui.app().panels().view.springs, opened.view.springs);
  EXPECT_FALSE(opened.view.points);
}

TEST(Placement, ABrokenMeshIsReportedAndNothingIsInserted) {
  ScratchFolder scratch;
  std::ofstream(scratch.folder / "broken.obj") << "v 0 0 zero\n";
  GuiFixture gui(is_3d_only());
  gui.app().handle(Request(StartPlacement{nullptr}));
  gui.app().handle(Request(LoadMesh{scratch.folder / "broken.obj"}));
  gui.frames(2);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Message);
  EXPECT_NE(gui.app().panels().dialog.text.find("line 1"), std::string::npos) << gui.app().panels().dialog.text;
  EXPECT_EQ(gui.system().point_count(), 0);
}

}  // namespace
}  // namespace hooke
