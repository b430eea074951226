// The tools that build and remove: add, attach, nail, delete, cut.
#include "app/tools/tools.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/new_point.h"
#include "scene/parameters.h"
#include "scene/spring_laws.h"
#include "support/tool_fixture.h"
#include "support/tool_scenes.h"

namespace hooke {
namespace {

TEST(AddTool, PutsAPointUnderTheCursorInThePlaneOfAFlatScene) {
  ToolFixture fixture(flat_scene({}));
  fixture.context.camera.orbit(0.5, 0.3);  // even in an oblique view
  const auto tool = make_add_tool();
  fixture.click(*tool, b);
  ASSERT_EQ(fixture.system().point_count(), 1);
  EXPECT_NEAR(distance(fixture.position(0), b), 0.0, 1e-9);
  EXPECT_EQ(fixture.position(0).z, 0.0);
  EXPECT_EQ(fixture.system().points()[0].mass, 1.0);
  EXPECT_EQ(fixture.system().points()[0].radius, 0.02);
}

TEST(AddTool, AddsPointsLikeThoseOfTheScene) {
  Scene scene = flat_scene({a, c, nowhere});
  for (Index i = 0; i < 3; ++i) {
    scene.system.point(i).mass = 1e-3 * (i + 1);
    scene.system.point(i).radius = 0.005 * (i + 1);
  }
  scene.system.append_spring({.id = scene.system.new_spring_id(),
                              .first = scene.system.points()[0].id,
                              .second = scene.system.points()[1].id,
                              .stiffness = 1.0,
                              .rest_length = 1.0});
  ToolFixture fixture(scene);
  const auto tool = make_add_tool();
  // alone: like the points that are attached to nothing
  fixture.click(*tool, b);
  EXPECT_EQ(fixture.system().points()[3].mass, 3e-3);
  EXPECT_EQ(fixture.system().points()[3].radius, 0.015);
  // attached: like the neighbor
  fixture.drag(*tool, a, {0.0, 0.0, 0.0});
  ASSERT_EQ(fixture.system().point_count(), 5);
  EXPECT_EQ(fixture.system().points()[4].mass, 1e-3);
  EXPECT_EQ(fixture.system().points()[4].radius, 0.005);
  // what the user sets has priority
  fixture.lab.submit(Command(SetParameter{find_parameter("new_mass"), 0.5}));
  fixture.settle();
  fixture.click(*tool, {0.5, -0.2, 0.0});
  EXPECT_EQ(fixture.system().points()[5].mass, 0.5);
  EXPECT_EQ(fixture.system().points()[5].radius, 0.015);
}

TEST(AddTool, AddsABallToTheTrampoline) {
  const Scene scene = load_scene(find_scene("trampoline")).scene;
  const NewPoint ball = new_point_like(scene.defaults, scene.system);
  EXPECT_EQ(ball.mass, scene.system.points()[0].mass);
  EXPECT_EQ(ball.radius, scene.system.points()[0].radius);
  // the two touch
  Lab lab(scene);
  const Vec3 above = scene.state.position[0] + Vec3(0.03, 0.3, 0.0);
  lab.submit(Insert{.points = {{.point = {.id = lab.new_point_id(), .mass = ball.mass, .radius = ball.radius}, .position = above}}});
  double nearest = 1.0;
  for (int i = 0; i < 60; ++i) {
    lab.step();
    const std::vector<Vec3>& places = lab.scene().state.position;
    nearest = std::min(nearest, distance(places.front(), places.back()));
  }
  EXPECT_GE(nearest, 2.0 * ball.radius - 1e-3);
  EXPECT_LT(nearest, 2.0 * ball.radius + 0.02);
  // the median of a scene of one piece, whatever single points are
  Scene cloth = load_scene(find_scene("cloth")).scene;
  const double inner = cloth.system.points()[cloth.system.point_count() / 2 + 5].mass;
  cloth.system.point(0).mass = 1e3;
  EXPECT_EQ(new_point_like(cloth.defaults, cloth.system).mass, inner);
}

Scene deep_scene() {
  Scene scene;
  scene.system.dimensions = 3;
  scene.system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}}, {.shape = Sphere{{0.0, 0.0, -2.0}, 0.5}}};
  scene.defaults.radius = 0.03;
  return scene;
}

TEST(AddTool, In3DUsesThePlaneThroughTheTargetThatFacesTheViewer) {
  ToolFixture fixture(deep_scene());
  fixture.context.camera.orbit(0.6, 0.2);
  const auto tool = make_add_tool();
  const glm::dvec2 cursor(500.0, 120.0);  // above the horizon
  tool->press({cursor, {}}, fixture.context);
  fixture.settle();
  const Vec3 place = fixture.position(0);
  EXPECT_NEAR(distance(Vec3(fixture.seen(place), 0.0), Vec3(cursor, 0.0)), 0.0, 1e-6);
  EXPECT_NEAR(glm::dot(place - fixture.context.camera.target, fixture.context.camera.back), 0.0, 1e-9);
}

TEST(AddTool, PlacesOnTheBallUnderTheCursor) {
  ToolFixture fixture(deep_scene());
  const auto tool = make_add_tool();
  fixture.click(*tool, {0.1, 0.1, -2.0});  // behind the target plane
  EXPECT_NEAR(distance(fixture.position(0), {0.0, 0.0, -2.0}), 0.5 + 0.03, 1e-9);
}

TEST(AddTool, PlacesOnTheGroundOnlyInFrontOfTheTargetPlane) {
  ToolFixture fixture(deep_scene());
  fixture.context.camera.orbit(0.0, 0.5);
  const auto tool = make_add_tool();
  fixture.click(*tool, {0.6, -1.0, 1.0});
  EXPECT_NEAR(fixture.position(0).y, -1.0 + 0.03, 1e-9);
  fixture.click(*tool, {1.5, -1.0, -4.0});
  EXPECT_GT(fixture.position(1).y, -0.9);
}

TEST(AddTool, ShowsWhereThePointWillBe) {
  ToolFixture fixture(flat_scene({}));
  Marks marks;
  make_add_tool()->mark(fixture.pointer(c), fixture.context, marks);
  ASSERT_TRUE(marks.ghost_point);
  EXPECT_NEAR(distance(*marks.ghost_point, c), 0.0, 1e-9);
}

TEST(AttachTool, TwoClicksMakeASpringAtItsDrawnLength) {
  Scene scene = flat_scene({a, b});
  scene.defaults.stiffness = 7.0;
  scene.defaults.damping = 0.5;
  ToolFixture fixture(scene);
  const auto tool = make_attach_tool();
  fixture.click(*tool, a);
  EXPECT_NE(tool->next_step(fixture.context).find("next point"), std::string::npos);
  fixture.click(*tool, b);
  ASSERT_EQ(fixture.system().spring_count(), 1);
  const Spring& spring = fixture.system().springs()[0];
  EXPECT_NEAR(spring.rest_length, distance(a, b), 1e-12);
  EXPECT_EQ(spring.stiffness, 7.0);
  EXPECT_EQ(spring.damping, 0.5);
  // and the chain goes on from there until Esc
  EXPECT_NE(tool->next_step(fixture.context).find("next point"), std::string::npos);
  EXPECT_TRUE(tool->cancel(fixture.context));
  EXPECT_NE(tool->next_step(fixture.context).find("first point"), std::string::npos);
}

TEST(AttachTool, MakesSpringsOfTheLawForNewOnes) {
  for (std::size_t law = 0; law < new_springs.size(); ++law) {
    Scene scene = flat_scene({a, b});
    scene.defaults.law = static_cast<int>(law);
    ToolFixture fixture(scene);
    const auto tool = make_attach_tool();
    fixture.drag(*tool, a, b);
    ASSERT_EQ(fixture.system().spring_count(), 1) << new_springs[law].id;
    const Spring& spring = fixture.system().springs()[0];
    EXPECT_EQ(spring.law, new_spring_law(static_cast<int>(law), scene.defaults.stiffness, spring.rest_length)) << new_springs[law].id;
  }
}

TEST(AttachTool, ADragFromPointToPointMakesASpringAndEndsThere) {
  ToolFixture fixture(flat_scene({a, b, c}));
  const auto tool = make_attach_tool();
  fixture.drag(*tool, a, b);
  EXPECT_EQ(fixture.system().spring_count(), 1);
  fixture.click(*tool, c);  // a first point again
  EXPECT_EQ(fixture.system().spring_count(), 1);
}

TEST(AttachTool, ADragIntoEmptySpaceAddsAndAttachesTheNextPointInOneStep) {
  for (const auto& make : {make_attach_tool, make_add_tool}) {
    ToolFixture fixture(flat_scene({a, b}));
    const auto tool = make();
    fixture.drag(*tool, a, nowhere);
    ASSERT_EQ(fixture.system().point_count(), 3);
    ASSERT_EQ(fixture.system().spring_count(), 1);
    EXPECT_NEAR(distance(fixture.position(2), nowhere), 0.0, 1e-9);
    EXPECT_NEAR(fixture.system().springs()[0].rest_length, distance(a, nowhere), 1e-9);
    fixture.submit(Undo{});
    EXPECT_EQ(fixture.system().point_count(), 2);
    EXPECT_EQ(fixture.system().spring_count(), 0);
  }
}

TEST(AttachTool, PlainClicksContinueTheChainAndAddThePointsThatAreMissing) {
  ToolFixture fixture(flat_scene({a, b}));
  const auto tool = make_attach_tool();
  fixture.click(*tool, a);
  fixture.click(*tool, nowhere);
  fixture.click(*tool, c);
  fixture.click(*tool, b);
  ASSERT_EQ(fixture.system().point_count(), 4);
  ASSERT_EQ(fixture.system().spring_count(), 3);
  for (Index s = 0; s + 1 < 3; ++s) EXPECT_EQ(fixture.system().springs()[s].second, fixture.system().springs()[s + 1].first);
  EXPECT_TRUE(tool->cancel(fixture.context));
}

TEST(AttachTool, TheSamePointTwiceOrEscEndsTheChain) {
  ToolFixture fixture(flat_scene({a, b}));
  const auto tool = make_attach_tool();
  fixture.click(*tool, a);
  fixture.click(*tool, a);
  EXPECT_FALSE(tool->cancel(fixture.context));
  fixture.click(*tool, a);
  EXPECT_TRUE(tool->cancel(fixture.context));
  fixture.click(*tool, b);
  EXPECT_EQ(fixture.system().spring_count(), 0);
  EXPECT_EQ(fixture.system().point_count(), 2);
}

TEST(BuildingTools, SnapToTheDrawnGridWithCtrl) {
  ToolFixture fixture(flat_scene({a}));
  const double spacing = grid_spacing(fixture.context.camera);
  Pointer pointer = fixture.pointer({0.237, -0.118, 0.0});
  pointer.modifiers.control = true;
  const auto add = make_add_tool(), attach = make_attach_tool();
  add->press(pointer, fixture.context);
  fixture.settle();
  const Vec3 place = fixture.position(1);
  EXPECT_NEAR(std::remainder(place.x, spacing), 0.0, 1e-12);
  EXPECT_NEAR(std::remainder(place.y, spacing), 0.0, 1e-12);
  EXPECT_LT(distance(place, {0.237, -0.118, 0.0}), spacing);
  EXPECT_NE(place, Vec3(0.237, -0.118, 0.0));
  Marks marks;
  fixture.click(*attach, a);
  pointer.at = fixture.seen({0.52, 0.31, 0.0});
  attach->mark(pointer, fixture.context, marks);
  ASSERT_TRUE(marks.ghost_spring);
  EXPECT_NEAR(std::remainder(marks.ghost_spring->second.x, spacing), 0.0, 1e-12);
}

// A truss over two supports, of eight points as a new flat scene makes them.
TEST(NewScenes, HaveDefaultsWithWhichATrussStands) {
  Scene scene = empty_scene();
  const Defaults& defaults = scene.defaults;
  std::vector<PointId> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(scene.system.new_point_id());
    // five below, three above
    scene.state.position.emplace_back(i < 5 ? 0.5 * i - 1.0 : 0.5 * (i - 5) - 0.5, i < 5 ? 0.0 : 0.45, 0.0);
    scene.state.velocity.emplace_back(0.0);
    scene.system.append_point({.id = points.back(), .nailed = i == 0 || i == 4, .mass = defaults.mass, .radius = 0.02});
  }
  const std::pair<int, int> bars[] = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {5, 6}, {6, 7}, {0, 5},
                                      {5, 1}, {1, 6}, {6, 2}, {5, 2}, {2, 7}, {7, 3}, {7, 4}};
  for (const auto& [i, j] : bars)
    scene.system.append_spring(
        {.id = scene.system.new_spring_id(),
         .first = points[static_cast<std::size_t>(i)],
         .second = points[static_cast<std::size_t>(j)],
         .stiffness = defaults.stiffness,
         .damping = defaults.damping,
         .rest_length = distance(scene.state.position[static_cast<std::size_t>(i)], scene.state.position[static_cast<std::size_t>(j)])});
  const std::vector<Vec3> start = scene.state.position;
  Lab lab(scene);
  constexpr double span = 2.0;
  double sag = 0.0;
  for (int frame = 0; frame < 300; ++frame) {
    ASSERT_TRUE(lab.step());
    sag = 0.0;
    for (std::size_t i = 0; i < start.size(); ++i) sag = std::max(sag, distance(start[i], lab.scene().state.position[i]));
    ASSERT_LT(sag, 0.03 * span) << frame;
  }
  EXPECT_LT(sag, 0.02 * span);
  // 2 zeta = d / sqrt(k m / 2) for a spring between two free points
  EXPECT_NEAR(defaults.damping / (2.0 * std::sqrt(0.5 * defaults.stiffness * defaults.mass)), 0.05, 0.006);
}

TEST(AttachTool, SurvivesDeletionOfItsFirstPoint) {
  ToolFixture fixture(flat_scene({a, b}));
  const auto tool = make_attach_tool();
  fixture.click(*tool, a);
  fixture.lab.submit(Remove{.points = {fixture.system().points()[0].id}});
  fixture.settle();
  Marks marks;
  tool->mark(fixture.pointer(b), fixture.context, marks);
  fixture.click(*tool, b);
  EXPECT_EQ(fixture.system().spring_count(), 0);
}

TEST(NailTool, NailsAndReleasesThePointUnderTheCursorDuringARun) {
  ToolFixture fixture(flat_scene({a, b}));
  fixture.submit(SetRunning{true});
  const auto tool = make_nail_tool();
  fixture.click(*tool, b);
  EXPECT_FALSE(fixture.system().points()[0].nailed);
  EXPECT_TRUE(fixture.system().points()[1].nailed);
  fixture.click(*tool, b);
  EXPECT_FALSE(fixture.system().points()[1].nailed);
}

TEST(DeleteTool, DeletesAPointWithItsSpringsOrASingleSpring) {
  ToolFixture fixture(flat_scene({a, b, c}));
  const auto attach = make_attach_tool(), tool = make_delete_tool();
  fixture.drag(*attach, a, b);
  fixture.drag(*attach, b, c);
  fixture.click(*tool, 0.5 * (a + b));
  EXPECT_EQ(fixture.system().spring_count(), 1);
  EXPECT_EQ(fixture.system().point_count(), 3);
  fixture.click(*tool, c);
  EXPECT_EQ(fixture.system().spring_count(), 0);
  EXPECT_EQ(fixture.system().point_count(), 2);
}

TEST(CutTool, CutsTheSpringsItIsDraggedAcrossAsOneStep) {
  ToolFixture fixture(flat_scene({a, b, c}));
  const auto attach = make_attach_tool(), tool = make_cut_tool();
  fixture.drag(*attach, a, b);
  fixture.drag(*attach, a, c);
  fixture.drag(*attach, b, c);
  fixture.drag(*tool, {-0.25, 0.6, 0.0}, {-0.15, -0.7, 0.0});
  EXPECT_EQ(fixture.system().spring_count(), 1);
  fixture.submit(Undo{});
  EXPECT_EQ(fixture.system().spring_count(), 3);
}

TEST(CutTool, RemovesTheFacesAlongCutSpringsDuringARun) {
  Scene scene = parse_scene(R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [-0.4, 0.4, 0], "across": [0.8, 0, 0],
    "down": [0, -0.8, 0], "points": [5, 5], "stiffness": 100, "nail": ["border"]}]})",
                            "test")
                    .scene;
  ToolFixture fixture(scene);
  fixture.submit(SetRunning{true});
  const auto tool = make_cut_tool();
  fixture.press(*tool, {-0.12, 0.7, 0.0});
  fixture.follow(*tool, {-0.12, 0.1, 0.0});
  EXPECT_EQ(tool->stroke().size(), 2u);
  fixture.release(*tool, {-0.12, -0.05, 0.0});
  EXPECT_TRUE(tool->stroke().empty());
  // down through the second column of cells to the center: three rows of springs across, and the diagonals of the cells between
  EXPECT_EQ(scene.system.spring_count() - fixture.system().spring_count(), 3 + 4);
  EXPECT_EQ(fixture.system().faces.size(), scene.system.faces.size() - 5);
  fixture.submit(Undo{});
  EXPECT_EQ(fixture.system(), scene.system);
}

TEST(Tools, EachDescribesItsNextStepAndIsInTheTableOnce) {
  ToolFixture fixture(flat_scene({a}));
  for (const ToolRow& row : tools()) {
    EXPECT_FALSE(row.make()->next_step(fixture.context).empty()) << shortcut_of(row.action).text;
    EXPECT_EQ(std::ranges::count(tools(), row.action, &ToolRow::action), 1);
  }
}

}  // namespace
}  // namespace hooke
