// Parts that pass through each other are highlighted until they are apart.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "support/gui_fixture.h"
#include "support/parse_text.h"

namespace hooke {
namespace {

// A triangle that moves out of another one.
Scene leaving_triangle() {
  return parse(R"({"hooke": 1, "gravity": [0, 0, 0], "contact": {"faces": true},
    "points": [{"position": [-1, -1, 0], "nailed": true}, {"position": [1, -1, 0], "nailed": true}, {"position": [0, 1, 0], "nailed": true},
               {"position": [-0.2, 0, -0.5], "velocity": [0, 0, 4]}, {"position": [0.2, 0, -0.5], "velocity": [0, 0, 4]},
               {"position": [0, 0.1, 0.5], "velocity": [0, 0, 4]}],
    "springs": [{"points": [3, 4], "stiffness": 100}, {"points": [4, 5], "stiffness": 100}, {"points": [5, 3], "stiffness": 100}],
    "faces": [[0, 1, 2], [3, 4, 5]]})");
}

TEST(Crossings, AreHighlightedUntilThePartsAreApart) {
  GuiFixture gui(leaving_triangle());
  ASSERT_NE(gui.app().marks().crossed, nullptr);
  EXPECT_EQ(gui.app().marks().crossed->edges.size(), 2u);
  EXPECT_NE(gui.text().find("2 edges pass through faces, as highlighted"), std::string::npos);
  gui.key(Key::Space);
  EXPECT_TRUE(gui.wait_until([&] { return !gui.app().marks().crossed; }));
  EXPECT_EQ(gui.app().marks().crossed, nullptr);
  EXPECT_GT(gui.status().snapshot->state.time, 0.05);
  gui.frames(2);
  EXPECT_EQ(gui.text().find("through faces"), std::string::npos);
}

TEST(Crossings, AreHighlightedWhenContactIsSwitchedOn) {
  Scene scene = leaving_triangle();
  scene.system.contact.faces = false;
  GuiFixture gui(scene);
  EXPECT_EQ(gui.app().marks().crossed, nullptr);
  gui.app().handle(Request(Edit{SetParameter{find_parameter("contact_faces"), 1.0}}));
  gui.settled();
  gui.frames(2);
  EXPECT_NE(gui.app().marks().crossed, nullptr);
}

// A ball is deleted in a run, and restored when a sheet has moved to where it was.
TEST(Crossings, AreHighlightedWhenUndoRestoresABallInASheet) {
  GuiFixture gui(parse(R"({"hooke": 1, "gravity": [0, 0, 0], "contact": {"faces": true},
    "points": [{"position": [-1, 0, -1], "velocity": [0, 1, 0]}, {"position": [1, 0, -1], "velocity": [0, 1, 0]},
               {"position": [0, 0, 1], "velocity": [0, 1, 0]}, {"position": [0, 0.5, 0], "radius": 0.2}],
    "springs": [{"points": [0, 1], "stiffness": 100}, {"points": [1, 2], "stiffness": 100}, {"points": [2, 0], "stiffness": 100}],
    "faces": [[0, 1, 2]]})"));
  EXPECT_EQ(gui.app().marks().crossed, nullptr);
  const PointId ball = gui.system().points()[3].id;
  gui.app().handle(Request(Edit{Remove{.points = {ball}}}));
  gui.app().handle(Request(Control(RunTo{0.55})));
  EXPECT_TRUE(gui.wait_until([&] { return !(gui.status().snapshot->state.time < 0.549); }));
  EXPECT_EQ(gui.app().marks().crossed, nullptr);
  gui.key(Key::Space);
  gui.key(letter('Z'), {.control = true});
  EXPECT_TRUE(gui.wait_until([&] { return gui.app().marks().crossed; }));
  ASSERT_NE(gui.app().marks().crossed, nullptr);
  EXPECT_EQ(gui.app().marks().crossed->spheres, std::vector<PointId>{ball});
  EXPECT_NE(gui.text().find("1 point overlaps faces or springs, as highlighted"), std::string::npos);
}

// A hand pulls the corner of a triangle through a nailed one.
TEST(Crossings, AreHighlightedWhereTheHandForcesThem) {
  GuiFixture gui(parse(R"({"hooke": 1, "gravity": [0, 0, 0], "contact": {"faces": true},
    "points": [{"position": [-1, 0, -1], "nailed": true}, {"position": [1, 0, -1], "nailed": true}, {"position": [0, 0, 1], "nailed": true},
               {"position": [0, 0.2, 0]}, {"position": [0.3, 0.4, 0]}, {"position": [-0.3, 0.4, 0]}],
    "springs": [{"points": [3, 4], "stiffness": 100}, {"points": [4, 5], "stiffness": 100}, {"points": [5, 3], "stiffness": 100}],
    "faces": [[0, 1, 2], [3, 4, 5]],
    "hand": {"point": 3, "circle": {"from": [0, 0.2, 0], "center": [0, 0, 0], "axis": [0, 0, 1]}, "speed": 1, "seconds": 0.6}})"));
  EXPECT_EQ(gui.app().marks().crossed, nullptr);
  gui.app().handle(Request(Control(RunTo{0.45})));
  EXPECT_TRUE(gui.wait_until([&] { return !(gui.status().snapshot->state.time < 0.449); }));
  gui.frames(2);
  EXPECT_NE(gui.app().marks().crossed, nullptr);
}

}  // namespace
}  // namespace hooke
