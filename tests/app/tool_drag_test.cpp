// The drag tool: points, cloths and colliders.
#include "app/tools/tools.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "support/tool_fixture.h"
#include "support/tool_scenes.h"

namespace hooke {
namespace {

TEST(DragTool, MovesAPointWhilePausedAsOneUndoStep) {
  ToolFixture fixture(flat_scene({a, b}));
  const auto tool = make_drag_tool();
  // grabbed beside the center of the point, which does not jump
  const Vec3 beside(0.01, 0.0, 0.0);
  fixture.drag(*tool, a + beside, c + beside);
  EXPECT_NEAR(distance(fixture.position(0), c), 0.0, 1e-9);
  EXPECT_EQ(fixture.position(1), b);
  fixture.submit(Undo{});
  EXPECT_EQ(fixture.position(0), a);
  EXPECT_EQ(fixture.context.status->history.undo_name, "");
}

TEST(DragTool, HoldsThePointExactlyDuringARunAndReleasesItWithTheVelocityOfTheHand) {
  Scene scene = flat_scene({a, b});
  scene.system.switches.drag = false;
  ToolFixture fixture(scene);
  fixture.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  fixture.press(*tool, a);
  fixture.follow(*tool, c);
  ASSERT_TRUE(wait_for([&] { return distance(fixture.lab.status()->snapshot->state.position[0], c) < 1e-9; }));
  fixture.settle();
  EXPECT_TRUE(fixture.system().grab);
  // a hand that keeps moving until it releases
  Vec3 hand = c;
  for (int i = 0; i < 60; ++i) {
    hand.x += 0.02;
    fixture.follow(*tool, hand);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  fixture.release(*tool, hand);
  EXPECT_FALSE(fixture.system().grab);
  EXPECT_GT(fixture.velocity(0).x, 0.1);
}

TEST(DragTool, EscUndoesTheDrag) {
  ToolFixture fixture(flat_scene({a, b}));
  const auto tool = make_drag_tool();
  fixture.press(*tool, a);
  fixture.follow(*tool, c);
  EXPECT_TRUE(tool->cancel(fixture.context));
  fixture.settle();
  EXPECT_EQ(fixture.position(0), a);
  fixture.release(*tool, c);
  EXPECT_EQ(fixture.position(0), a);
  EXPECT_FALSE(tool->cancel(fixture.context));
}

TEST(DragTool, PullsIfTheSceneSaysSoExceptForANailedPoint) {
  Scene scene = flat_scene({a, b});
  scene.defaults.grab = GrabKind::Pull;
  scene.defaults.pull_stiffness = 3.0;
  scene.system.point(1).nailed = true;
  ToolFixture fixture(scene);
  fixture.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  fixture.press(*tool, a);
  ASSERT_TRUE(fixture.system().grab);
  EXPECT_EQ(fixture.system().grab->kind, GrabKind::Pull);
  EXPECT_EQ(fixture.system().grab->stiffness, 3.0);
  fixture.release(*tool, a);
  fixture.press(*tool, b);
  ASSERT_TRUE(fixture.system().grab);
  EXPECT_EQ(fixture.system().grab->kind, GrabKind::Hold);
}

// One face in 3-D, its corners far apart in the picture.
Scene face() {
  Scene scene = flat_scene({a, b, c});
  scene.system.dimensions = 3;
  scene.system.faces = std::vector<Face>{{{PointId{0}, PointId{1}, PointId{2}}}};
  return scene;
}

TEST(DragTool, PullsAClothAtThePositionUnderTheCursor) {
  ToolFixture fixture(face());
  fixture.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  const Vec3 place = 0.2 * a + 0.3 * b + 0.5 * c, target = place + Vec3(0.3, 0.1, 0.0);
  fixture.press(*tool, place);
  ASSERT_TRUE(fixture.system().grab);
  const Grab taken = *fixture.system().grab;
  EXPECT_EQ(taken.kind, GrabKind::Pull);
  ASSERT_TRUE(taken.patch);
  EXPECT_EQ(taken.patch->points, (std::array{PointId{0}, PointId{1}, PointId{2}}));
  for (std::size_t p = 0; p < 3; ++p) EXPECT_NEAR(taken.patch->weights[p], (std::array{0.2, 0.3, 0.5})[p], 1e-9);
  EXPECT_EQ(taken.point, PointId{2});
  EXPECT_LT(distance(fixture.context.snapshot().state.hand.target, place), 1e-9);

  // the target moves with the cursor in the plane that faces the viewer
  fixture.follow(*tool, target);
  EXPECT_LT(distance(fixture.context.snapshot().state.hand.target, target), 1e-9);
  Marks marks;
  tool->mark(fixture.pointer(target), fixture.context, marks);
  EXPECT_TRUE(marks.ghost_point);
  ASSERT_TRUE(marks.ghost_spring);
  EXPECT_FALSE(marks.hovered_point);

  fixture.release(*tool, target);
  EXPECT_FALSE(fixture.system().grab);
  EXPECT_EQ(fixture.context.status->history.undo_name, "drag the cloth");
  fixture.submit(SetRunning{false});
  fixture.submit(Undo{});
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(fixture.position(i), (std::array{a, b, c})[i]);
}

TEST(DragTool, PrefersAPointOfAClothNearTheCursor) {
  ToolFixture fixture(face());
  fixture.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  fixture.press(*tool, a + 0.01 * (b + c - 2.0 * a));
  ASSERT_TRUE(fixture.system().grab);
  EXPECT_EQ(fixture.system().grab->point, PointId{0});
  EXPECT_FALSE(fixture.system().grab->patch);
}

TEST(DragTool, MovesTheNearestCornerOfAClothWhilePaused) {
  ToolFixture fixture(face());
  const auto tool = make_drag_tool();
  const Vec3 place = 0.2 * a + 0.3 * b + 0.5 * c, displacement(0.2, 0.1, 0.0);
  fixture.drag(*tool, place, place + displacement);
  EXPECT_LT(distance(fixture.position(2), c + displacement), 1e-9);
  EXPECT_EQ(fixture.position(0), a);
  EXPECT_EQ(fixture.position(1), b);
}

TEST(DragTool, DoesNotGrabAHiddenSurface) {
  ToolFixture fixture(face());
  fixture.context.shows_surface = false;
  fixture.submit(SetRunning{true});
  fixture.press(*make_drag_tool(), 0.2 * a + 0.3 * b + 0.5 * c);
  EXPECT_FALSE(fixture.system().grab);
}

TEST(DragTool, ReleasesAClothThatLosesACorner) {
  ToolFixture fixture(face());
  fixture.submit(SetRunning{true});
  const auto tool = make_drag_tool();
  const Vec3 place = 0.2 * a + 0.3 * b + 0.5 * c;
  fixture.press(*tool, place);
  fixture.lab.submit(Command(Remove{{PointId{0}}, {}}));
  fixture.settle();
  EXPECT_FALSE(fixture.system().grab);
  fixture.follow(*tool, place + Vec3(0.1, 0.0, 0.0));
  fixture.release(*tool, place);
  EXPECT_EQ(fixture.system().point_count(), 2);
}

TEST(DragTool, GrabsAColliderWhereThereIsNoPoint) {
  const Vec3 ball(0.4, -0.3, 0.0), displacement(-0.5, 0.2, 0.0);
  for (const int dimensions : {2, 3})
    for (const bool running : {false, true}) {
      ToolFixture fixture(ball_scene(dimensions));
      fixture.submit(SetRunning{running});
      const auto tool = make_drag_tool();
      fixture.press(*tool, ball);
      fixture.follow(*tool, ball + displacement);
      EXPECT_EQ(fixture.context.snapshot().state.hand.collider.has_value(), running);
      // in 3-D it is grabbed at its front, which is nearer, so it moves slightly less
      if (!running) {
        EXPECT_LT(distance(anchor_of(fixture.system().colliders[0]), ball + displacement),
                  dimensions == 2 ? 1e-6 : 0.06 * glm::length(displacement));
      }
      fixture.release(*tool, ball + displacement);
      EXPECT_FALSE(fixture.context.snapshot().state.hand.collider);
      fixture.submit(Undo{});
      EXPECT_EQ(fixture.system().colliders, ball_scene(dimensions).system.colliders);
    }
}

}  // namespace
}  // namespace hooke
