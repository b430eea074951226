// The selection tool.
#include "app/tools/tools.h"

#include <gtest/gtest.h>

#include "app/view/arrows.h"
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

// Press, move and release with these keys held.
void drag_with(ToolFixture& fixture, Tool& tool, const Vec3& from, const Vec3& to, Modifiers modifiers) {
  const auto at = [&](const Vec3& place) { return Pointer{fixture.seen(place), modifiers}; };
  tool.press(at(from), fixture.context);
  for (const double fraction : {0.5, 1.0}) tool.follow(at(glm::mix(from, to, fraction)), fixture.context);
  tool.release(at(to), fixture.context);
  fixture.settle();
}

TEST(SelectTool, AltAndADragSetTheVelocityOfTheSelectionAsOneStep) {
  ToolFixture fixture(flat_scene({a, b}));
  const auto tool = make_select_tool();
  drag_with(fixture, *tool, a, a + Vec3(0.2, 0.1, 0.0), {.alt = true});
  const double seconds = velocity_arrow_seconds(fixture.context.view_height());
  EXPECT_LT(glm::distance(fixture.velocity(0), Vec3(0.2, 0.1, 0.0) / seconds), 1e-9);
  EXPECT_EQ(fixture.velocity(1), Vec3(0.0));
  EXPECT_EQ(fixture.position(0), a);
  EXPECT_TRUE(fixture.context.status->history.undo_name.starts_with("velocity of 1 point to "));
  fixture.submit(Undo{});
  EXPECT_EQ(fixture.velocity(0), Vec3(0.0));
}

TEST(SelectTool, ALassoSelectsWhatItsPathEncloses) {
  ToolFixture fixture(flat_scene({a, b, c}));
  const auto tool = make_select_tool();
  const auto at = [&](const Vec3& place) { return Pointer{fixture.seen(place), {.control = true}}; };
  // a wedge whose box would contain all three points
  tool->press(at({-0.9, 0.9, 0.0}), fixture.context);
  for (const Vec3& place : {Vec3(0.9, 0.9, 0.0), Vec3(0.9, -0.2, 0.0), Vec3(-0.9, 0.6, 0.0)}) tool->follow(at(place), fixture.context);
  EXPECT_GT(tool->stroke().size(), 2u);
  EXPECT_FALSE(tool->rubber_band());
  tool->release(at({-0.9, 0.6, 0.0}), fixture.context);
  EXPECT_EQ(fixture.selection.points, std::vector{fixture.system().points()[1].id});
}

TEST(SelectTool, HandlesAroundTheSelectionTurnAndScaleIt) {
  ToolFixture fixture(flat_scene({a, b}));
  fixture.drag(*make_attach_tool(), a, b);
  fixture.selection = {{fixture.system().points()[0].id, fixture.system().points()[1].id}, {}};
  const auto tool = make_select_tool();
  Marks marks;
  tool->mark({}, fixture.context, marks);
  ASSERT_EQ(marks.ghost_nails.size(), 4u);
  ASSERT_TRUE(marks.ghost_point);
  const Vec3 center = 0.5 * (a + b), corner = marks.ghost_nails[0], turn = *marks.ghost_point;
  const double length = glm::distance(a, b);

  fixture.drag(*tool, corner, center + 2.0 * (corner - center));
  EXPECT_NEAR(glm::distance(fixture.position(0), fixture.position(1)), 2.0 * length, 1e-9);
  EXPECT_NEAR(fixture.system().springs()[0].rest_length, 2.0 * length, 1e-9);
  EXPECT_EQ(fixture.context.status->history.undo_name, "scale 2 points");
  fixture.submit(Undo{});
  EXPECT_NEAR(fixture.system().springs()[0].rest_length, length, 1e-12);
  EXPECT_LT(glm::distance(fixture.position(0), a), 1e-12);

  // from above to the left: a quarter turn
  const Vec3 arm = turn - center;
  fixture.drag(*tool, turn, center + Vec3(-arm.y, arm.x, 0.0));
  const Vec3 along = a - center;
  EXPECT_LT(glm::distance(fixture.position(0), center + Vec3(-along.y, along.x, 0.0)), 1e-9);
  EXPECT_NEAR(fixture.system().springs()[0].rest_length, length, 1e-12);
}

}  // namespace
}  // namespace hooke
