// The selection tool.
#include "app/tools/tools.h"

#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "support/tool_scenes.h"
#include "support/tool_trial.h"

namespace hooke {
namespace {

TEST(SelectTool, MovesABallButStartsABoxSelectionOnTheGround) {
  const Vec3 ball(0.4, -0.3, 0.0), displacement(-0.5, 0.2, 0.0);
  ToolTrial trial(ball_scene(2));
  const auto tool = make_select_tool();
  trial.drag(*tool, ball, ball + displacement);
  EXPECT_LT(distance(anchor_of(trial.system().colliders[0]), ball + displacement), 1e-6);
  trial.press(*tool, {0.0, -0.9, 0.0});
  trial.follow(*tool, {0.2, -0.7, 0.0});
  EXPECT_TRUE(tool->rubber_band());
  tool->cancel(trial.context);
}

TEST(SelectTool, ClicksSelectAndShiftAddsAndRemoves) {
  ToolTrial trial(flat_scene({a, b}));
  const PointId first = trial.system().points()[0].id, second = trial.system().points()[1].id;
  trial.drag(*make_attach_tool(), a, b);
  const auto tool = make_select_tool();
  trial.click(*tool, a);
  EXPECT_EQ(trial.selection, (Selection{{first}, {}}));
  trial.click(*tool, b, true);
  EXPECT_EQ(trial.selection, (Selection{{first, second}, {}}));
  trial.click(*tool, a, true);
  EXPECT_EQ(trial.selection, (Selection{{second}, {}}));
  trial.click(*tool, 0.5 * (a + b));
  EXPECT_EQ(trial.selection, (Selection{{}, {trial.system().springs()[0].id}}));
  trial.click(*tool, nowhere);
  EXPECT_TRUE(trial.selection.empty());
}

TEST(SelectTool, ADragFromEmptySpaceSelectsABox) {
  ToolTrial trial(flat_scene({a, b, c}));
  const auto tool = make_select_tool();
  trial.press(*tool, {-0.9, 0.9, 0.0});
  trial.follow(*tool, {0.9, -0.2, 0.0});
  EXPECT_TRUE(tool->rubber_band());
  trial.release(*tool, {0.9, -0.2, 0.0});
  EXPECT_EQ(trial.selection.points.size(), 2u);
  trial.drag(*tool, {0.4, -0.3, 0.0}, {0.0, -0.8, 0.0}, true);
  EXPECT_EQ(trial.selection.points.size(), 3u);
}

TEST(SelectTool, DraggingASelectedPointMovesTheSelectionAsOneStep) {
  ToolTrial trial(flat_scene({a, b, c}));
  const auto tool = make_select_tool();
  trial.click(*tool, a);
  trial.click(*tool, b, true);
  const Vec3 displacement(0.2, 0.15, 0.0);
  trial.drag(*tool, a, a + displacement);
  EXPECT_NEAR(distance(trial.position(0), a + displacement), 0.0, 1e-9);
  EXPECT_NEAR(distance(trial.position(1), b + displacement), 0.0, 1e-9);
  EXPECT_EQ(trial.position(2), c);
  trial.submit(Undo{});
  EXPECT_EQ(trial.position(0), a);
  EXPECT_EQ(trial.position(1), b);
}

TEST(SelectTool, AnUnsteadyClickMovesNothing) {
  ToolTrial trial(flat_scene({a}));
  const auto tool = make_select_tool();
  trial.drag(*tool, a, a + Vec3(0.008, 0.0, 0.0));
  EXPECT_EQ(trial.position(0), a);
  EXPECT_EQ(trial.context.status->history.undo_name, "");
}

TEST(SelectTool, EscUndoesAMove) {
  ToolTrial trial(flat_scene({a}));
  const auto tool = make_select_tool();
  trial.press(*tool, a);
  trial.follow(*tool, c);
  EXPECT_NEAR(distance(trial.position(0), c), 0.0, 1e-9);
  EXPECT_TRUE(tool->cancel(trial.context));
  trial.settle();
  EXPECT_EQ(trial.position(0), a);
}

}  // namespace
}  // namespace hooke
