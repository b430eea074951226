// Edits of several points at once.
#include "edit/arrange.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "edit/command.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// Two springs of 1 m along x, the right half moving up.
Scene bar() {
  TestSim sim;
  const PointId a = sim.add({0.0, 0.0, 0.0}, 1.0), b = sim.add({1.0, 0.0, 0.0}, 2.0), c = sim.add({2.0, 0.5, 0.0}, 3.0, {0.0, 1.0, 0.0});
  sim.join(a, b, 50.0, 1.0);
  sim.join(b, c, 60.0, 1.0);
  Scene scene;
  scene.system = sim.system;
  scene.state = sim.state;
  return scene;
}

Snapshot snapshot_of(const Scene& scene) { return {.system = std::make_shared<const System>(scene.system), .state = scene.state}; }

std::vector<PointId> all_of(const Scene& scene) { return select_all(scene.system).points; }

void take(Scene& scene, const std::vector<Command>& commands) {
  for (const Command& command : commands) {
    Effect effect;
    apply(scene, command, effect);
  }
}

IdSource ids_of(Scene& scene) {
  return {[&scene] { return scene.system.new_point_id(); }, [&scene] { return scene.system.new_spring_id(); }};
}

TEST(Arrange, ScalingChangesRestLengthsAndTurningChangesVelocities) {
  Scene scene = bar();
  const Vec3 center = center_of(snapshot_of(scene), all_of(scene));
  EXPECT_EQ(center, Vec3(1.0, 0.25, 0.0));
  take(scene, moved(snapshot_of(scene), all_of(scene),
                    {.about = center, .turn = rotation({0.0, 0.0, 1.0}, 0.5 * 3.14159265358979323846), .scale = 3.0}));
  EXPECT_LT(glm::distance(scene.state.position[0], Vec3(1.75, -2.75, 0.0)), 1e-12);
  EXPECT_LT(glm::distance(scene.state.velocity[2], Vec3(-1.0, 0.0, 0.0)), 1e-12);
  EXPECT_DOUBLE_EQ(scene.system.springs()[1].rest_length, 3.0);
}

TEST(Arrange, AReflectionTwiceIsNothing) {
  Scene scene = bar();
  const Scene before = scene;
  for (int i = 0; i < 2; ++i) {
    const Vec3 center = center_of(snapshot_of(scene), all_of(scene));
    take(scene, moved(snapshot_of(scene), all_of(scene), {.about = center, .turn = reflection(0)}));
    EXPECT_EQ(scene.state == before.state, i == 1);
  }
}

TEST(Arrange, AligningAndDistributing) {
  Scene scene = bar();
  scene.state.position[1].x = 0.3;
  const std::vector<PointId> all = all_of(scene);
  take(scene, {aligned(snapshot_of(scene), all, 1), distributed(snapshot_of(scene), all, 0)});
  EXPECT_DOUBLE_EQ(scene.state.position[1].x, 1.0);
  take(scene, {aligned(snapshot_of(scene), all, 1)});
  for (const Vec3& place : scene.state.position) EXPECT_DOUBLE_EQ(place.y, scene.state.position[0].y);
}

TEST(Arrange, WeldingKeepsMassMomentumAndSpringsAndSplittingDividesTheMass) {
  Scene scene = bar();
  const std::vector<PointId> ends = {scene.system.points()[0].id, scene.system.points()[2].id};
  take(scene, weld(snapshot_of(scene), scene.sheet.get(), ends, ids_of(scene)));
  ASSERT_EQ(scene.system.point_count(), 2);
  ASSERT_EQ(scene.system.spring_count(), 2);
  EXPECT_DOUBLE_EQ(scene.system.points()[0].mass, 4.0);
  EXPECT_LT(glm::distance(scene.state.position[0], Vec3(1.5, 0.375, 0.0)), 1e-12);
  EXPECT_LT(glm::distance(scene.state.velocity[0], Vec3(0.0, 0.75, 0.0)), 1e-12);
  EXPECT_EQ(scene.system.springs()[1].stiffness, 60.0);

  take(scene, split(snapshot_of(scene), scene.sheet.get(), {scene.system.points()[1].id}, ids_of(scene)));
  EXPECT_EQ(scene.system.point_count(), 3);
  EXPECT_EQ(scene.system.spring_count(), 2);
  EXPECT_DOUBLE_EQ(scene.system.points()[1].mass, 1.0);
  EXPECT_TRUE(split(snapshot_of(scene), scene.sheet.get(), {scene.system.points()[1].id}, ids_of(scene)).empty());
}

TEST(Arrange, WeldingAddsLoadsAndFixedAxesAndSplittingDividesLoads) {
  Scene scene = bar();
  for (Index i : {0, 1}) scene.system.point(i).load = {0.0, -3.0, 1.0};
  scene.system.point(0).fixed_axes = 2;
  scene.system.point(1).fixed_axes = 4;
  take(scene, split(snapshot_of(scene), scene.sheet.get(), {scene.system.points()[1].id}, ids_of(scene)));
  EXPECT_EQ(scene.system.points()[1].load, Vec3(0.0, -1.5, 0.5));
  EXPECT_EQ(scene.system.points()[3].load, Vec3(0.0, -1.5, 0.5));
  take(scene, weld(snapshot_of(scene), scene.sheet.get(), {scene.system.points()[0].id, scene.system.points()[1].id}, ids_of(scene)));
  EXPECT_EQ(scene.system.points()[0].load, Vec3(0.0, -4.5, 1.5));
  EXPECT_EQ(scene.system.points()[0].fixed_axes, 6);
}

TEST(Arrange, WeldedAndSplitSpringsKeepTheirShareOfTheSheet) {
  for (const bool welds : {true, false}) {
    Scene scene = bar();
    SheetWeights weights;
    weights.spring_weight = std::vector<double>{0.75, 0.5};
    scene.sheet = std::make_shared<const SheetWeights>(weights);
    const auto& points = scene.system.points();
    take(scene, welds ? weld(snapshot_of(scene), scene.sheet.get(), {points[0].id, points[2].id}, ids_of(scene))
                      : split(snapshot_of(scene), scene.sheet.get(), {points[1].id}, ids_of(scene)));
    EXPECT_EQ(sheet_weight_of(scene.sheet.get(), scene.system.springs()[0].id), 0.75);
    EXPECT_EQ(sheet_weight_of(scene.sheet.get(), scene.system.springs()[1].id), 0.5);
  }
}

TEST(Arrange, WeldingTheEndsOfASpringRemovesIt) {
  Scene scene = bar();
  take(scene, weld(snapshot_of(scene), scene.sheet.get(), {scene.system.points()[0].id, scene.system.points()[1].id}, ids_of(scene)));
  EXPECT_EQ(scene.system.point_count(), 2);
  ASSERT_EQ(scene.system.spring_count(), 1);
  EXPECT_EQ(scene.system.springs()[0].stiffness, 60.0);
}

TEST(Arrange, NeighborsAreSplitTogether) {
  Scene scene = bar();
  const PointId d = scene.system.new_point_id();
  take(scene, {Insert{.points = {{.point = {.id = d}, .position = {3.0, 0.0, 0.0}}},
                      .springs = {{.spring = {.id = scene.system.new_spring_id(), .first = scene.system.points()[2].id, .second = d}}}}});
  take(scene, split(snapshot_of(scene), scene.sheet.get(), all_of(scene), ids_of(scene)));
  EXPECT_EQ(scene.system.point_count(), 6);
  EXPECT_EQ(scene.system.spring_count(), 3);
}

}  // namespace
}  // namespace hooke
