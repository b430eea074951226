// The drag tool: points, cloths and colliders.
#include "app/tools/tools.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "support/tool_scenes.h"
#include "support/tool_trial.h"

namespace hooke {
namespace {

TEST(DragTool, MovesAPointWhilePausedAsOneUndoStep) {
  ToolTrial trial(flat_scene({a, b}));
  const auto tool = make_drag_tool();
  // grabbed beside the center of the point, which does not jump
  const Vec3 beside(0.01, 0.0, 0.0);
  trial.drag(*tool, a + beside, c + beside);
  EXPECT_NEAR(distance(trial.position(0), c), 0.0, 1e-9);
  EXPECT_EQ(trial.position(1), b);
  trial.submit(Undo{});
  EXPECT_EQ(trial.position(0), a);
  EXPECT_EQ(trial.context.status->history.undo_name, "");
}

TEST(DragTool, HoldsThePointExactlyDuringARunAndReleasesItWithTheVelocityOfTheHand) {
  Scene scene = flat_scene({a, b});
  scene.system.drag_on = false;
  ToolTrial trial(scene);
  trial.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  trial.press(*tool, a);
  trial.follow(*tool, c);
  ASSERT_TRUE(wait_for([&] { return distance(trial.lab.status()->snapshot->state.position[0], c) < 1e-9; }));
  trial.settle();
  EXPECT_TRUE(trial.system().grab);
  // a hand that keeps moving until it releases
  Vec3 hand = c;
  for (int i = 0; i < 60; ++i) {
    hand.x += 0.02;
    trial.follow(*tool, hand);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  trial.release(*tool, hand);
  EXPECT_FALSE(trial.system().grab);
  EXPECT_GT(trial.velocity(0).x, 0.1);
}

TEST(DragTool, EscUndoesTheDrag) {
  ToolTrial trial(flat_scene({a, b}));
  const auto tool = make_drag_tool();
  trial.press(*tool, a);
  trial.follow(*tool, c);
  EXPECT_TRUE(tool->cancel(trial.context));
  trial.settle();
  EXPECT_EQ(trial.position(0), a);
  trial.release(*tool, c);
  EXPECT_EQ(trial.position(0), a);
  EXPECT_FALSE(tool->cancel(trial.context));
}

TEST(DragTool, PullsIfTheSceneSaysSoExceptForANailedPoint) {
  Scene scene = flat_scene({a, b});
  scene.defaults.grab = GrabKind::Pull;
  scene.defaults.pull_stiffness = 3.0;
  scene.system.point(1).nailed = true;
  ToolTrial trial(scene);
  trial.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  trial.press(*tool, a);
  ASSERT_TRUE(trial.system().grab);
  EXPECT_EQ(trial.system().grab->kind, GrabKind::Pull);
  EXPECT_EQ(trial.system().grab->stiffness, 3.0);
  trial.release(*tool, a);
  trial.press(*tool, b);
  ASSERT_TRUE(trial.system().grab);
  EXPECT_EQ(trial.system().grab->kind, GrabKind::Hold);
}

// One face in 3-D, its corners far apart in the picture.
Scene face() {
  Scene scene = flat_scene({a, b, c});
  scene.system.dimensions = 3;
  scene.system.faces = {{{PointId{0}, PointId{1}, PointId{2}}}};
  return scene;
}

TEST(DragTool, PullsAClothAtThePositionUnderTheCursor) {
  ToolTrial trial(face());
  trial.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  const Vec3 place = 0.2 * a + 0.3 * b + 0.5 * c, target = place + Vec3(0.3, 0.1, 0.0);
  trial.press(*tool, place);
  ASSERT_TRUE(trial.system().grab);
  const Grab taken = *trial.system().grab;
  EXPECT_EQ(taken.kind, GrabKind::Pull);
  ASSERT_TRUE(taken.patch);
  EXPECT_EQ(taken.patch->points, (std::array{PointId{0}, PointId{1}, PointId{2}}));
  for (std::size_t p = 0; p < 3; ++p) EXPECT_NEAR(taken.patch->weights[p], (std::array{0.2, 0.3, 0.5})[p], 1e-9);
  EXPECT_EQ(taken.point, PointId{2});
  EXPECT_LT(distance(trial.context.snapshot().state.hand.target, place), 1e-9);

  // the target moves with the cursor in the plane that faces the viewer
  trial.follow(*tool, target);
  EXPECT_LT(distance(trial.context.snapshot().state.hand.target, target), 1e-9);
  Marks marks;
  tool->mark(trial.pointer(target), trial.context, marks);
  EXPECT_TRUE(marks.ghost_point);
  ASSERT_TRUE(marks.ghost_spring);
  EXPECT_FALSE(marks.hovered_point);

  trial.release(*tool, target);
  EXPECT_FALSE(trial.system().grab);
  EXPECT_EQ(trial.context.status->history.undo_name, "drag the cloth");
  trial.submit(SetRunning{false});
  trial.submit(Undo{});
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(trial.position(i), (std::array{a, b, c})[i]);
}

TEST(DragTool, PrefersAPointOfAClothNearTheCursor) {
  ToolTrial trial(face());
  trial.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  trial.press(*tool, a + 0.01 * (b + c - 2.0 * a));
  ASSERT_TRUE(trial.system().grab);
  EXPECT_EQ(trial.system().grab->point, PointId{0});
  EXPECT_FALSE(trial.system().grab->patch);
}

TEST(DragTool, MovesTheNearestCornerOfAClothWhilePaused) {
  ToolTrial trial(face());
  const auto tool = make_drag_tool();
  const Vec3 place = 0.2 * a + 0.3 * b + 0.5 * c, displacement(0.2, 0.1, 0.0);
  trial.drag(*tool, place, place + displacement);
  EXPECT_LT(distance(trial.position(2), c + displacement), 1e-9);
  EXPECT_EQ(trial.position(0), a);
  EXPECT_EQ(trial.position(1), b);
}

TEST(DragTool, DoesNotGrabAHiddenSurface) {
  ToolTrial trial(face());
  trial.context.shows_surface = false;
  trial.submit(SetRunning{true});
  trial.press(*make_drag_tool(), 0.2 * a + 0.3 * b + 0.5 * c);
  EXPECT_FALSE(trial.system().grab);
}

TEST(DragTool, ReleasesAClothThatLosesACorner) {
  ToolTrial trial(face());
  trial.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  const Vec3 place = 0.2 * a + 0.3 * b + 0.5 * c;
  trial.press(*tool, place);
  trial.lab.submit(Command(Remove{{PointId{0}}, {}}));
  trial.settle();
  EXPECT_FALSE(trial.system().grab);
  trial.follow(*tool, place + Vec3(0.1, 0.0, 0.0));
  trial.release(*tool, place);
  EXPECT_EQ(trial.system().point_count(), 2);
}

TEST(DragTool, GrabsAColliderWhereThereIsNoPoint) {
  const Vec3 ball(0.4, -0.3, 0.0), displacement(-0.5, 0.2, 0.0);
  for (const int dimensions : {2, 3})
    for (const bool running : {false, true}) {
      ToolTrial trial(ball_scene(dimensions));
      trial.submit(SetRunning{running});
      const auto tool = make_drag_tool();
      trial.press(*tool, ball);
      trial.follow(*tool, ball + displacement);
      EXPECT_EQ(trial.context.snapshot().state.hand.collider.has_value(), running);
      // in 3-D it is grabbed at its front, which is nearer, so it moves slightly less
      if (!running) {
        EXPECT_LT(distance(anchor_of(trial.system().colliders[0]), ball + displacement),
                  dimensions == 2 ? 1e-6 : 0.06 * glm::length(displacement));
      }
      trial.release(*tool, ball + displacement);
      EXPECT_FALSE(trial.context.snapshot().state.hand.collider);
      trial.submit(Undo{});
      EXPECT_EQ(trial.system().colliders, ball_scene(dimensions).system.colliders);
    }
}

}  // namespace
}  // namespace hooke
