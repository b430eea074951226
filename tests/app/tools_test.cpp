// The tools: the effect of mouse presses, moves and releases, while running and paused.
#include "app/tools/tools.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/tools/tune.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "support/tool_trial.h"

namespace hooke {
namespace {

const Vec3 a(-0.5, 0.1, 0.0), b(0.4, 0.3, 0.0), c(0.1, -0.5, 0.0), nowhere(0.9, 0.9, 0.0);

double distance(const Vec3& from, const Vec3& to) { return glm::distance(from, to); }

TEST(AddTool, PutsAPointUnderTheCursorInThePlaneOfAFlatScene) {
  ToolTrial trial(flat_scene({}));
  trial.context.camera.orbit(0.5, 0.3);  // even in an oblique view
  const auto tool = make_add_tool();
  trial.click(*tool, b);
  ASSERT_EQ(trial.system().point_count(), 1);
  EXPECT_NEAR(distance(trial.position(0), b), 0.0, 1e-9);
  EXPECT_EQ(trial.position(0).z, 0.0);
  EXPECT_EQ(trial.system().points()[0].mass, trial.context.status->document->defaults.mass);
}

Scene deep_scene() {
  Scene scene;
  scene.system.dimensions = 3;
  scene.system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}}, {.shape = Sphere{{0.0, 0.0, -2.0}, 0.5}}};
  scene.defaults.radius = 0.03;
  return scene;
}

TEST(AddTool, In3DUsesThePlaneThroughTheTargetThatFacesTheViewer) {
  ToolTrial trial(deep_scene());
  trial.context.camera.orbit(0.6, 0.2);
  const auto tool = make_add_tool();
  const glm::dvec2 cursor(500.0, 120.0);  // above the horizon
  tool->press({cursor, {}}, trial.context);
  trial.settle();
  const Vec3 place = trial.position(0);
  EXPECT_NEAR(distance(Vec3(trial.seen(place), 0.0), Vec3(cursor, 0.0)), 0.0, 1e-6);
  EXPECT_NEAR(glm::dot(place - trial.context.camera.target, trial.context.camera.back), 0.0, 1e-9);
}

TEST(AddTool, PlacesOnTheBallUnderTheCursor) {
  ToolTrial trial(deep_scene());
  const auto tool = make_add_tool();
  trial.click(*tool, {0.1, 0.1, -2.0});  // behind the target plane
  EXPECT_NEAR(distance(trial.position(0), {0.0, 0.0, -2.0}), 0.5 + 0.03, 1e-9);
}

TEST(AddTool, PlacesOnTheGroundOnlyInFrontOfTheTargetPlane) {
  ToolTrial trial(deep_scene());
  trial.context.camera.orbit(0.0, 0.5);
  const auto tool = make_add_tool();
  trial.click(*tool, {0.6, -1.0, 1.0});
  EXPECT_NEAR(trial.position(0).y, -1.0 + 0.03, 1e-9);
  trial.click(*tool, {1.5, -1.0, -4.0});
  EXPECT_GT(trial.position(1).y, -0.9);
}

TEST(AddTool, ShowsWhereThePointWillBe) {
  ToolTrial trial(flat_scene({}));
  Marks marks;
  make_add_tool()->mark(trial.pointer(c), trial.context, marks);
  ASSERT_TRUE(marks.ghost_point);
  EXPECT_NEAR(distance(*marks.ghost_point, c), 0.0, 1e-9);
}

TEST(AttachTool, TwoClicksMakeASpringAtItsDrawnLength) {
  Scene scene = flat_scene({a, b});
  scene.defaults.stiffness = 7.0;
  scene.defaults.damping = 0.5;
  ToolTrial trial(scene);
  const auto tool = make_attach_tool();
  trial.click(*tool, a);
  EXPECT_NE(tool->next_step(trial.context).find("second point"), std::string::npos);
  trial.click(*tool, b);
  ASSERT_EQ(trial.system().spring_count(), 1);
  const Spring& spring = trial.system().springs()[0];
  EXPECT_NEAR(spring.rest_length, distance(a, b), 1e-12);
  EXPECT_EQ(spring.stiffness, 7.0);
  EXPECT_EQ(spring.damping, 0.5);
  EXPECT_NE(tool->next_step(trial.context).find("first point"), std::string::npos);
}

TEST(AttachTool, ADragFromPointToPointMakesASpring) {
  ToolTrial trial(flat_scene({a, b}));
  const auto tool = make_attach_tool();
  trial.drag(*tool, a, b);
  EXPECT_EQ(trial.system().spring_count(), 1);
  trial.drag(*tool, a, nowhere);  // released over nothing
  trial.click(*tool, b);          // is a first point again
  EXPECT_EQ(trial.system().spring_count(), 1);
}

TEST(AttachTool, WithShiftTheSecondPointStartsTheNextSpring) {
  ToolTrial trial(flat_scene({a, b, c}));
  const auto tool = make_attach_tool();
  trial.click(*tool, a, true);
  trial.click(*tool, b, true);
  trial.click(*tool, c);
  ASSERT_EQ(trial.system().spring_count(), 2);
  EXPECT_EQ(trial.system().springs()[1].first, trial.system().springs()[0].second);
}

TEST(AttachTool, TheSamePointTwiceEmptySpaceAndEscMakeNoSpring) {
  ToolTrial trial(flat_scene({a, b}));
  const auto tool = make_attach_tool();
  trial.click(*tool, a);
  trial.click(*tool, nowhere);  // still waiting for the second point
  trial.click(*tool, a);
  EXPECT_FALSE(tool->cancel(trial.context));
  trial.click(*tool, a);
  EXPECT_TRUE(tool->cancel(trial.context));
  trial.click(*tool, b);
  EXPECT_EQ(trial.system().spring_count(), 0);
}

TEST(AttachTool, SurvivesDeletionOfItsFirstPoint) {
  ToolTrial trial(flat_scene({a, b}));
  const auto tool = make_attach_tool();
  trial.click(*tool, a);
  trial.lab.submit(Remove{.points = {trial.system().points()[0].id}});
  trial.settle();
  Marks marks;
  tool->mark(trial.pointer(b), trial.context, marks);
  trial.click(*tool, b);
  EXPECT_EQ(trial.system().spring_count(), 0);
}

TEST(NailTool, NailsAndReleasesThePointUnderTheCursorDuringARun) {
  ToolTrial trial(flat_scene({a, b}));
  trial.submit(SetRunning{true});
  const auto tool = make_nail_tool();
  trial.click(*tool, b);
  EXPECT_FALSE(trial.system().points()[0].nailed);
  EXPECT_TRUE(trial.system().points()[1].nailed);
  trial.click(*tool, b);
  EXPECT_FALSE(trial.system().points()[1].nailed);
}

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

TEST(DeleteTool, DeletesAPointWithItsSpringsOrASingleSpring) {
  ToolTrial trial(flat_scene({a, b, c}));
  const auto attach = make_attach_tool(), tool = make_delete_tool();
  trial.drag(*attach, a, b);
  trial.drag(*attach, b, c);
  trial.click(*tool, 0.5 * (a + b));
  EXPECT_EQ(trial.system().spring_count(), 1);
  EXPECT_EQ(trial.system().point_count(), 3);
  trial.click(*tool, c);
  EXPECT_EQ(trial.system().spring_count(), 0);
  EXPECT_EQ(trial.system().point_count(), 2);
}

TEST(CutTool, CutsTheSpringsItIsDraggedAcrossAsOneStep) {
  ToolTrial trial(flat_scene({a, b, c}));
  const auto attach = make_attach_tool(), tool = make_cut_tool();
  trial.drag(*attach, a, b);
  trial.drag(*attach, a, c);
  trial.drag(*attach, b, c);
  trial.drag(*tool, {-0.25, 0.6, 0.0}, {-0.15, -0.7, 0.0});
  EXPECT_EQ(trial.system().spring_count(), 1);
  trial.submit(Undo{});
  EXPECT_EQ(trial.system().spring_count(), 3);
}

TEST(CutTool, RemovesTheFacesAlongCutSpringsDuringARun) {
  Scene scene = parse_scene(R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [-0.4, 0.4, 0], "across": [0.8, 0, 0],
    "down": [0, -0.8, 0], "points": [5, 5], "stiffness": 100, "nail": ["border"]}]})",
                            "test")
                    .scene;
  ToolTrial trial(scene);
  trial.submit(SetRunning{true});
  const auto tool = make_cut_tool();
  trial.press(*tool, {-0.12, 0.7, 0.0});
  trial.follow(*tool, {-0.12, 0.1, 0.0});
  EXPECT_EQ(tool->stroke().size(), 2u);
  trial.release(*tool, {-0.12, -0.05, 0.0});
  EXPECT_TRUE(tool->stroke().empty());
  // down through the second column of cells to the center: three rows of springs across, and the diagonals of the cells between
  EXPECT_EQ(scene.system.spring_count() - trial.system().spring_count(), 3 + 4);
  EXPECT_EQ(trial.system().faces.size(), scene.system.faces.size() - 5);
  trial.submit(Undo{});
  EXPECT_EQ(trial.system(), scene.system);
}

Scene ball_scene(int dimensions) {
  Scene scene = flat_scene({a});
  scene.system.dimensions = dimensions;
  scene.system.colliders = {{.shape = Sphere{{0.4, -0.3, 0.0}, 0.2}}, {.shape = Plane{{0.0, -0.8, 0.0}, {0.0, 1.0, 0.0}}}};
  return scene;
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

TEST(Tools, EachDescribesItsNextStepAndIsInTheTableOnce) {
  ToolTrial trial(flat_scene({a}));
  for (const ToolRow& row : tools()) {
    EXPECT_FALSE(row.make()->next_step(trial.context).empty()) << shortcut_of(row.action).text;
    EXPECT_EQ(std::ranges::count(tools(), row.action, &ToolRow::action), 1);
  }
}

// The effect of the arrow keys.

Scene sprung_scene(std::initializer_list<double> stiffnesses) {
  Trial trial;
  std::vector<PointId> points = {trial.add(Vec3(0.0))};
  for (const double k : stiffnesses) {
    points.push_back(trial.add({0.1 * static_cast<double>(points.size()), 0.0, 0.0}));
    trial.join(points[points.size() - 2], points.back(), k, 0.1);
  }
  Scene scene;
  scene.system = trial.system;
  scene.state = trial.state;
  return scene;
}

void submit_all(ToolTrial& trial, const Tuning& tuning) {
  const Gesture gesture = trial.context.begin_gesture();
  for (const Command& command : tuning.commands) trial.lab.submit(command, gesture);
  trial.settle();
}

TEST(Tune, StiffnessScalesEverySpringAndTheDefaultByATenthAsOneStep) {
  ToolTrial trial(sprung_scene({100.0, 40.0}));
  const Tuning tuning = tune_stiffness(*trial.context.status, {}, +1);
  EXPECT_EQ(tuning.message, "k = 44 to 110 N/m (all springs)");
  submit_all(trial, tuning);
  EXPECT_DOUBLE_EQ(trial.system().springs()[0].stiffness, 110.0);
  EXPECT_DOUBLE_EQ(trial.system().springs()[1].stiffness, 44.0);
  EXPECT_DOUBLE_EQ(trial.context.status->document->defaults.stiffness, 110.0);
  trial.submit(Undo{});
  EXPECT_EQ(trial.system().springs()[0].stiffness, 100.0);
  EXPECT_EQ(trial.context.status->document->defaults.stiffness, 100.0);
}

TEST(Tune, StiffnessOfASelectionLeavesOtherSpringsUnchanged) {
  ToolTrial trial(sprung_scene({100.0, 40.0}));
  submit_all(trial, tune_stiffness(*trial.context.status, {{}, {trial.system().springs()[1].id}}, -1));
  EXPECT_EQ(trial.system().springs()[0].stiffness, 100.0);
  EXPECT_DOUBLE_EQ(trial.system().springs()[1].stiffness, 40.0 / 1.1);
  EXPECT_EQ(trial.context.status->document->defaults.stiffness, 100.0);
}

TEST(Tune, StiffnessFollowsTheStepsAndLimitsOfTheScene) {
  Scene scene = sprung_scene({});
  scene.controls = {0.1, 10.0, 0.1};
  scene.defaults.stiffness = 9.9;
  ToolTrial trial(scene);
  for (const double expected : {10.0, 10.0}) {
    submit_all(trial, tune_stiffness(*trial.context.status, {}, +1));
    EXPECT_DOUBLE_EQ(trial.context.status->document->defaults.stiffness, expected);
  }
  for (int i = 0; i < 120; ++i) submit_all(trial, tune_stiffness(*trial.context.status, {}, -1));
  EXPECT_DOUBLE_EQ(trial.context.status->document->defaults.stiffness, 0.1);
}

TEST(Tune, SubstepsChangeByFivesFromOneToAThousand) {
  ToolTrial trial(sprung_scene({}));
  const auto substeps = [&] { return trial.context.snapshot().settings.substeps; };
  const auto set = [&](double value) {
    trial.lab.submit(SetParameter{find_parameter("substeps"), value});
    trial.settle();
  };
  set(1);
  submit_all(trial, tune_substeps(*trial.context.status, +1));
  EXPECT_EQ(substeps(), 5);
  submit_all(trial, tune_substeps(*trial.context.status, +1));
  EXPECT_EQ(substeps(), 10);
  set(7);
  submit_all(trial, tune_substeps(*trial.context.status, -1));
  EXPECT_EQ(substeps(), 5);
  submit_all(trial, tune_substeps(*trial.context.status, -1));
  EXPECT_EQ(substeps(), 1);
  set(998);
  const Tuning tuning = tune_substeps(*trial.context.status, +1);
  submit_all(trial, tuning);
  EXPECT_EQ(substeps(), 1000);
  EXPECT_EQ(tuning.message, "1000 substeps per frame");
}

}  // namespace
}  // namespace hooke
