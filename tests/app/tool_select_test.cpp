// The selection tool.
#include "app/tools/tools.h"

#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "support/tool_fixture.h"
#include "support/tool_scenes.h"

namespace hooke {
namespace {

TEST(SelectTool, MovesABallButStartsABoxSelectionOnTheGround) {
  const Vec3 ball(0.4, -0.3, 0.0), displacement(-0.5, 0.2, 0.0);
  ToolFixture fixture(ball_scene(2));
  const auto tool = make_select_tool();
  fixture.drag(*tool, ball, ball + displacement);
  EXPECT_LT(distance(anchor_of(fixture.system().colliders[0]), ball + displacement), 1e-6);
  fixture.press(*tool, {0.0, -0.9, 0.0});
  fixture.follow(*tool, {0.2, -0.7, 0.0});
  EXPECT_TRUE(tool->rubber_band());
  tool->cancel(fixture.context);
}

TEST(SelectTool, ClicksSelectAndShiftAddsAndRemoves) {
  ToolFixture fixture(flat_scene({a, b}));
  const PointId first = fixture.system().points()[0].id, second = fixture.system().points()[1].id;
  fixture.drag(*make_attach_tool(), a, b);
  const auto tool = make_select_tool();
  fixture.click(*tool, a);
  EXPECT_EQ(fixture.selection, (Selection{{first}, {}}));
  fixture.click(*tool, b, true);
  EXPECT_EQ(fixture.selection, (Selection{{first, second}, {}}));
  fixture.click(*tool, a, true);
  EXPECT_EQ(fixture.selection, (Selection{{second}, {}}));
  fixture.click(*tool, 0.5 * (a + b));
  EXPECT_EQ(fixture.selection, (Selection{{}, {fixture.system().springs()[0].id}}));
  fixture.click(*tool, nowhere);
  EXPECT_TRUE(fixture.selection.empty());
}

TEST(SelectTool, ADragFromEmptySpaceSelectsABox) {
  ToolFixture fixture(flat_scene({a, b, c}));
  const auto tool = make_select_tool();
  fixture.press(*tool, {-0.9, 0.9, 0.0});
  fixture.follow(*tool, {0.9, -0.2, 0.0});
  EXPECT_TRUE(tool->rubber_band());
  fixture.release(*tool, {0.9, -0.2, 0.0});
  EXPECT_EQ(fixture.selection.points.size(), 2u);
  fixture.drag(*tool, {0.4, -0.3, 0.0}, {0.0, -0.8, 0.0}, true);
  EXPECT_EQ(fixture.selection.points.size(), 3u);
}

TEST(SelectTool, DraggingASelectedPointMovesTheSelectionAsOneStep) {
  ToolFixture fixture(flat_scene({a, b, c}));
  const auto tool = make_select_tool();
  fixture.click(*tool, a);
  fixture.click(*tool, b, true);
  const Vec3 displacement(0.2, 0.15, 0.0);
  fixture.drag(*tool, a, a + displacement);
  EXPECT_NEAR(distance(fixture.position(0), a + displacement), 0.0, 1e-9);
  EXPECT_NEAR(distance(fixture.position(1), b + displacement), 0.0, 1e-9);
  EXPECT_EQ(fixture.position(2), c);
  fixture.submit(Undo{});
  EXPECT_EQ(fixture.position(0), a);
  EXPECT_EQ(fixture.position(1), b);
}

TEST(SelectTool, AnUnsteadyClickMovesNothing) {
  ToolFixture fixture(flat_scene({a}));
  const auto tool = make_select_tool();
  fixture.drag(*tool, a, a + Vec3(0.008, 0.0, 0.0));
  EXPECT_EQ(fixture.position(0), a);
  EXPECT_EQ(fixture.context.status->history.undo_name, "");
}

TEST(SelectTool, EscUndoesAMove) {
  ToolFixture fixture(flat_scene({a}));
  const auto tool = make_select_tool();
  fixture.press(*tool, a);
  fixture.follow(*tool, c);
  EXPECT_NEAR(distance(fixture.position(0), c), 0.0, 1e-9);
  EXPECT_TRUE(tool->cancel(fixture.context));
  fixture.settle();
  EXPECT_EQ(fixture.position(0), a);
}

}  // namespace
}  // namespace hooke
