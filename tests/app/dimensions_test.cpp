// Flat and 3-D scenes: new ones of both kinds, and conversion between them.
#include <gtest/gtest.h>

#include "scene/flatness.h"
#include "scene/parameters.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"
#include "support/modifiers.h"

namespace hooke {
namespace {

Scene horizontal_pair() {
  TestSim sim;
  sim.join(sim.nail({-0.5, 0.0, 0.0}), sim.add({0.5, 0.0, 0.0}), 100.0, 1.0);
  return flat_scene("Two points", sim);
}

SetParameter set_dimensions(int dimensions) { return {&dimensions_parameter, dimensions == 3 ? 1.0 : 0.0}; }

TEST(NewScenes, AreFlatOr3D) {
  GuiFixture gui;
  gui.key(letter('N'), control);
  EXPECT_EQ(gui.system().dimensions, 2);
  gui.key(letter('N'), control_shift);
  EXPECT_EQ(gui.system().dimensions, 3);
  EXPECT_FALSE(gui.app().camera().orthographic);
  // something can be built at once, in front of the camera and above the floor
  gui.key(letter('A'));
  const Rect& view = gui.app().layout().scene;
  gui.click({view.x + 0.5 * view.width, view.y + 0.5 * view.height});
  ASSERT_EQ(gui.system().point_count(), 1);
  EXPECT_GT(gui.status().snapshot->state.position[0].y, -1.0);
}

TEST(Dimensions, AFlatSceneBecomesSpatialAndFlatAgain) {
  GuiFixture gui(horizontal_pair());
  gui.app().handle(Request(Edit{set_dimensions(3)}));
  gui.frames(2);
  EXPECT_EQ(gui.system().dimensions, 3);
  EXPECT_FALSE(gui.app().camera().orthographic);
  gui.key(letter('3'));  // from the side
  gui.app().handle(Request(Edit{set_dimensions(2)}));
  gui.frames(2);
  EXPECT_EQ(gui.system().dimensions, 2);
  EXPECT_TRUE(gui.app().camera().orthographic);
  EXPECT_EQ(gui.app().camera().back, (Vec3{0.0, 0.0, 1.0}));
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system().dimensions, 3);
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system().dimensions, 2);
}

TEST(Dimensions, AnythingOutOfThePlaneKeepsAScene3D) {
  GuiFixture gui(horizontal_pair());
  gui.app().handle(Request(Edit{set_dimensions(3)}));
  gui.app().handle(Request(Edit{Move{{{gui.system().points()[1].id, {0.5, 0.0, 0.2}, Vec3(0.0)}}}}));
  gui.app().handle(Request(Edit{set_dimensions(2)}));
  EXPECT_EQ(gui.system().dimensions, 3);
  EXPECT_EQ(why_not_flat(gui.system(), gui.status().snapshot->state), "point 1 is not at z = 0");
}

TEST(Dimensions, EachThingThatLeavesThePlaneIsNamed) {
  const auto reason = [](auto change) {
    Scene scene = horizontal_pair();
    scene.system.dimensions = 3;
    change(scene);
    return why_not_flat(scene.system, scene.state);
  };
  EXPECT_EQ(reason([](Scene&) {}), "");
  EXPECT_EQ(reason([](Scene& s) { s.state.velocity[1].z = 1.0; }), "point 1 moves along z");
  EXPECT_EQ(reason([](Scene& s) { s.system.gravity.z = 1.0; }), "gravity acts along z");
  EXPECT_NE(reason([](Scene& s) { s.system.colliders = {{.shape = Sphere{{0.0, 0.0, 0.1}, 0.5}}}; }), "");
  EXPECT_NE(reason([](Scene& s) { s.system.colliders = {{.shape = Plane{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}}}; }), "");
  EXPECT_EQ(reason([](Scene& s) { s.system.colliders = {{.shape = Box{Vec3(-1.0), Vec3(1.0)}}}; }), "");
}

TEST(AddMenu, AShapeThatNeedsSpaceOffersToMakeTheSceneSpatial) {
  GuiFixture gui(horizontal_pair());
  Panels& panels = gui.app().panels();
  Requests requests;
  start_placement(find_shape_kind("curtain"), gui.app().panel_input({}), panels, requests);
  EXPECT_TRUE(requests.empty());
  ASSERT_EQ(panels.dialog.kind, Dialog::Kind::Message);
  gui.frames(2);
  gui.key(Key::Enter);
  EXPECT_EQ(gui.system().dimensions, 3);
  EXPECT_TRUE(panels.placement.is_on());
  EXPECT_FALSE(gui.app().marks().ghost_lines.empty());
}

}  // namespace
}  // namespace hooke
