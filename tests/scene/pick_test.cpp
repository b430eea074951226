// Picking: the item shown under the cursor is selected, from any direction.
#include "scene/pick.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "draw/camera.h"
#include "scene/selection.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

constexpr double reach = 10.0;

struct Scenery {
  TestSim sim;
  Camera camera;
  glm::dvec2 size{800.0, 600.0};

  PointId ball(const Vec3& at, double radius) {
    const PointId id = sim.add(at);
    sim.system.point(sim.system.index_of(id)).radius = radius;
    return id;
  }
  Snapshot snapshot() const {
    Snapshot snapshot;
    snapshot.system = std::make_shared<const System>(sim.system);
    snapshot.state = sim.state;
    return snapshot;
  }
  ViewTransform view_transform() const { return {camera.projection_matrix(size.x / size.y) * camera.view_matrix(), size}; }
  glm::dvec2 seen(const Vec3& place) const { return *project_to_screen(view_transform(), place); }
};

// An oblique view of the origin.
Camera oblique(bool orthographic = false) {
  Camera camera;
  camera.orbit(0.7, 0.4);
  camera.distance = 4.0;
  camera.orthographic = orthographic;
  return camera;
}

TEST(Pick, ProjectsPositionsLikeTheCamera) {
  Scenery scenery;
  for (const bool orthographic : {false, true}) {
    scenery.camera = oblique(orthographic);
    for (const Vec3& place : {Vec3(0.0), Vec3(0.3, -0.2, 0.5), Vec3(-1.0, 0.4, -0.7)}) {
      const Vec3 projected = scenery.camera.project(place, scenery.size);
      EXPECT_NEAR(glm::distance(scenery.seen(place), glm::dvec2(projected.x, projected.y)), 0.0, 1e-9);
    }
  }
}

TEST(Pick, ARayPassesThroughThePositionShownAtItsPixel) {
  Scenery scenery;
  for (const bool orthographic : {false, true}) {
    scenery.camera = oblique(orthographic);
    const Vec3 place(0.3, -0.2, 0.5);
    const PickRay line = pick_ray(scenery.view_transform(), scenery.seen(place));
    const double along = glm::dot(place - line.origin, line.direction);
    EXPECT_NEAR(glm::length(line.direction), 1.0, 1e-12);
    EXPECT_NEAR(glm::distance(line.at(along), place), 0.0, 1e-9);
    EXPECT_GT(along, 0.0);
  }
}

TEST(Pick, IgnoresEverythingBehindTheViewer) {
  Scenery scenery;
  EXPECT_FALSE(project_to_screen(scenery.view_transform(), scenery.camera.eye() + Vec3(0.0, 0.0, 1.0)));
}

// Against the definition, for many points, positions and views.
TEST(Pick, FindsTheNearestPointWithinReach) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Scenery scenery;
  for (int i = 0; i < 60; ++i) scenery.ball({uniform(random), uniform(random), uniform(random)}, 0.0);
  const Snapshot snapshot = scenery.snapshot();
  int hits = 0;
  for (int sim = 0; sim < 400; ++sim) {
    scenery.camera = oblique(sim % 2 == 0);
    scenery.camera.orbit(3.0 * uniform(random), uniform(random));
    const glm::dvec2 cursor = scenery.size * (0.5 + 0.3 * glm::dvec2(uniform(random), uniform(random)));
    std::optional<PointId> nearest;
    double min = reach;
    for (const Point& point : snapshot.system->points()) {
      const double gap = glm::distance(scenery.seen(snapshot.position(point.id)), cursor);
      if (gap <= min) min = gap, nearest = point.id;
    }
    EXPECT_EQ(pick_point(snapshot, scenery.view_transform(), cursor, reach), nearest);
    hits += nearest ? 1 : 0;
  }
  EXPECT_GT(hits, 20);
}

TEST(Pick, TakesTheFrontBallWhereBallsOverlap) {
  Scenery scenery;
  const PointId behind = scenery.ball({0.0, 0.0, -0.5}, 0.1);
  const PointId before = scenery.ball({0.05, 0.0, 0.5}, 0.1);
  // over both, and closer to the center of the one behind
  const glm::dvec2 cursor = scenery.seen({0.0, 0.0, -0.5});
  EXPECT_EQ(pick_point(scenery.snapshot(), scenery.view_transform(), cursor, reach), before);
  scenery.sim.state.position[0].z = 0.9;
  EXPECT_EQ(pick_point(scenery.snapshot(), scenery.view_transform(), cursor, reach), behind);
}

TEST(Pick, FindsALargeBallAtItsEdge) {
  Scenery scenery;
  const PointId ball = scenery.ball(Vec3(0.0), 0.4);
  EXPECT_EQ(pick_point(scenery.snapshot(), scenery.view_transform(), scenery.seen({0.38, 0.0, 0.0}), reach), ball);
  EXPECT_FALSE(pick_point(scenery.snapshot(), scenery.view_transform(), scenery.seen({0.5, 0.0, 0.0}), reach));
}

TEST(Pick, DoesNotFindPointsBehindACollider) {
  Scenery scenery;
  scenery.camera = oblique();
  const PointId point = scenery.ball(-0.8 * scenery.camera.back, 0.02);
  const auto pick = [&] { return pick_point(scenery.snapshot(), scenery.view_transform(), 0.5 * scenery.size, reach); };
  EXPECT_EQ(pick(), point);
  scenery.sim.system.colliders = {{.shape = Sphere{Vec3(0.0), 0.5}}};
  EXPECT_FALSE(pick());
  // points on the near side can be picked, and so can those behind a collider that is only drawn
  scenery.sim.state.position[0] = 0.52 * scenery.camera.back;
  EXPECT_EQ(pick(), point);
  scenery.sim.state.position[0] = -0.8 * scenery.camera.back;
  scenery.sim.system.colliders[0].solid = false;
  EXPECT_EQ(pick(), point);
  // in a flat scene, the silhouette of a ball hides nothing
  scenery.sim.system.colliders[0].solid = true;
  scenery.sim.system.dimensions = 2;
  EXPECT_EQ(pick(), point);
}

TEST(Pick, FindsASpringNearItsMiddleAndNotBeyondItsEnds) {
  Scenery scenery;
  scenery.camera = oblique();
  const Vec3 from(-0.4, 0.1, 0.0), to(0.5, 0.2, 0.3);
  const SpringId spring = scenery.sim.join(scenery.ball(from, 0.0), scenery.ball(to, 0.0), 1.0, 1.0);
  const glm::dvec2 along = glm::normalize(scenery.seen(to) - scenery.seen(from)), beside(-along.y, along.x);
  const glm::dvec2 middle = scenery.seen(0.5 * (from + to));
  const auto pick = [&](const glm::dvec2& cursor) { return pick_spring(scenery.snapshot(), scenery.view_transform(), cursor, reach); };
  EXPECT_EQ(pick(middle + 0.9 * reach * beside), spring);
  EXPECT_FALSE(pick(middle + 1.1 * reach * beside));
  EXPECT_FALSE(pick(scenery.seen(to) + 1.1 * reach * along));
}

TEST(Pick, FindsASpringThatExtendsBehindTheViewer) {
  Scenery scenery;
  const Vec3 from = scenery.camera.eye() + Vec3(0.1, 0.1, 1.0), to(0.0, 0.0, -1.0);
  const SpringId spring = scenery.sim.join(scenery.ball(from, 0.0), scenery.ball(to, 0.0), 1.0, 1.0);
  const glm::dvec2 cursor = scenery.seen(glm::mix(to, from, 0.3));
  EXPECT_EQ(pick_spring(scenery.snapshot(), scenery.view_transform(), cursor, 2.0), spring);
}

TEST(Pick, IntersectsEachKindOfColliderAtItsSurface) {
  const PickRay down{{0.3, 5.0, 0.1}, {0.0, -1.0, 0.0}};
  System system;
  system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}}};
  const auto plane = hit_collider(system, {}, down);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->distance, 6.0, 1e-12);
  EXPECT_FALSE(plane->bounded);

  system.colliders.push_back({.shape = Box{{-1.0, -0.5, -1.0}, {1.0, 0.5, 1.0}}});
  const auto box = hit_collider(system, {}, down);
  EXPECT_NEAR(box->distance, 4.5, 1e-12);
  EXPECT_EQ(box->normal, Vec3(0.0, 1.0, 0.0));

  system.colliders.push_back({.shape = Sphere{Vec3(0.3, 1.0, 0.1), 0.5}});
  const auto sphere = hit_collider(system, {}, down);
  EXPECT_NEAR(sphere->distance, 3.5, 1e-12);
  EXPECT_NEAR(glm::distance(sphere->normal, Vec3(0.0, 1.0, 0.0)), 0.0, 1e-12);
  EXPECT_TRUE(sphere->bounded);

  // from inside or from below there is no surface to hit
  EXPECT_FALSE(hit_collider(system, {}, {{0.3, 1.0, 0.1}, {1.0, 0.0, 0.0}}));
  EXPECT_FALSE(hit_collider(system, {}, {{5.0, -3.0, 0.0}, {0.0, 1.0, 0.0}}));
}

TEST(Pick, ALassoSelectsThePointsInsideAndTheSpringsBetweenThem) {
  Scenery scenery;
  const PointId a = scenery.ball({-0.2, 0.1, 0.0}, 0.0), b = scenery.ball({0.2, -0.1, 0.5}, 0.0), c = scenery.ball({0.9, 0.0, 0.0}, 0.0);
  const SpringId inside = scenery.sim.join(a, b, 1.0, 1.0);
  scenery.sim.join(b, c, 1.0, 1.0);
  std::vector<glm::dvec2> outline;
  for (const Vec3& corner : {Vec3(0.5, -0.5, 0.0), Vec3(0.5, 0.5, 0.0), Vec3(-0.5, 0.5, 0.0), Vec3(-0.5, -0.5, 0.0)})
    outline.push_back(scenery.seen(corner));
  const auto points = points_within(scenery.snapshot(), scenery.view_transform(), outline);
  EXPECT_EQ(points, (std::vector{a, b}));
  EXPECT_EQ(select_with_springs_between(scenery.sim.system, points).springs, std::vector{inside});
}

TEST(Pick, ACutCrossesOnlyTheSpringsBetweenItsEnds) {
  Scenery scenery;
  const SpringId crossed = scenery.sim.join(scenery.ball({-0.5, 0.0, 0.0}, 0.0), scenery.ball({0.5, 0.0, 0.0}, 0.0), 1.0, 1.0);
  scenery.sim.join(scenery.ball({-0.5, 0.6, 0.0}, 0.0), scenery.ball({0.5, 0.6, 0.0}, 0.0), 1.0, 1.0);
  const auto cut =
      springs_across(scenery.snapshot(), scenery.view_transform(), scenery.seen({0.1, 0.3, 0.0}), scenery.seen({0.0, -0.3, 0.0}));
  EXPECT_EQ(cut, std::vector{crossed});
}

// A triangle in the plane z = 0, another behind it, and a point behind both.
struct Layers : Scenery {
  PointId behind;
  Layers() {
    camera = oblique();
    for (const double z : {0.0, -0.6})
      for (const Vec3& corner : {Vec3(-0.8, -0.6, z), Vec3(0.9, -0.7, z), Vec3(0.0, 0.8, z)}) ball(corner, 0.0);
    // the far one first, each with a different orientation: neither matters
    sim.system.faces = std::vector<Face>{{{PointId{3}, PointId{5}, PointId{4}}}, {{PointId{0}, PointId{1}, PointId{2}}}};
    behind = ball(-0.5 * camera.back, 0.02);
  }
  ViewTransform lens_with_surface() const {
    ViewTransform with = view_transform();
    with.shows_surface = true;
    return with;
  }
};

TEST(Pick, FindsTheVisibleSurfaceWithItsBarycentricWeights) {
  const Layers layers;
  const Vec3 places[] = {{0.1, -0.2, 0.0}, {-0.79, -0.5999, 0.0}, {0.0, 0.0, 0.0}};
  for (const Vec3& place : places) {
    const auto hit = pick_surface(layers.snapshot(), layers.view_transform(), layers.seen(place));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->patch.points, (std::array{PointId{0}, PointId{1}, PointId{2}}));
    EXPECT_LT(glm::distance(hit->position, place), 1e-9);
    Vec3 sum(0.0);
    double whole = 0.0;
    for (std::size_t p = 0; p < 3; ++p) {
      EXPECT_GE(hit->patch.weights[p], 0.0);
      whole += hit->patch.weights[p];
      sum += hit->patch.weights[p] * layers.sim.position(hit->patch.points[p]);
    }
    EXPECT_NEAR(whole, 1.0, 1e-15);
    EXPECT_LT(glm::distance(sum, place), 1e-9);
  }
  EXPECT_FALSE(pick_surface(layers.snapshot(), layers.view_transform(), layers.seen({0.9, 0.8, 0.0})));
}

TEST(Pick, FindsASurfaceFromBehindAndOneThatExtendsBehindTheViewer) {
  Layers layers;
  layers.camera.back = -layers.camera.back;
  const auto far = pick_surface(layers.snapshot(), layers.view_transform(), layers.seen({0.1, -0.2, -0.6}));
  ASSERT_TRUE(far);
  EXPECT_EQ(far->patch.points, (std::array{PointId{3}, PointId{5}, PointId{4}}));

  // a face that extends behind the viewer
  Scenery scenery;
  for (const Vec3& corner : {Vec3(-1.0, -0.1, -5.0), Vec3(1.0, -0.1, -5.0), Vec3(0.0, -0.1, 50.0)}) scenery.ball(corner, 0.0);
  scenery.sim.system.faces = std::vector<Face>{{{PointId{0}, PointId{1}, PointId{2}}}};
  EXPECT_TRUE(pick_surface(scenery.snapshot(), scenery.view_transform(), scenery.seen({0.0, -0.1, 1.0})));
}

TEST(Pick, FindsNoGapBetweenAdjacentFaces) {
  Scenery scenery;
  scenery.camera = oblique();
  const PointId a = scenery.ball({-0.7, -0.6, 0.1}, 0.0), b = scenery.ball({0.8, 0.5, -0.2}, 0.0);
  const PointId c = scenery.ball({0.5, -0.7, 0.0}, 0.0), d = scenery.ball({-0.4, 0.9, 0.3}, 0.0);
  scenery.sim.system.faces = std::vector<Face>{{{a, c, b}}, {{a, b, d}}};
  for (int i = 1; i < 1000; ++i) {
    const Vec3 edge_on_occlusion = glm::mix(scenery.sim.position(a), scenery.sim.position(b), i / 1000.0);
    EXPECT_TRUE(pick_surface(scenery.snapshot(), scenery.view_transform(), scenery.seen(edge_on_occlusion))) << i;
  }
}

TEST(Pick, DoesNotFindPointsBehindAVisibleSurface) {
  const Layers layers;
  const glm::dvec2 cursor = layers.seen(layers.sim.position(layers.behind));
  EXPECT_EQ(pick_point(layers.snapshot(), layers.view_transform(), cursor, reach), layers.behind);
  EXPECT_FALSE(pick_point(layers.snapshot(), layers.lens_with_surface(), cursor, reach));
  // a surface hides none of its own corners, from either side
  Layers turned = layers;
  for (const double side : {1.0, -1.0}) {
    turned.camera.back = side * layers.camera.back;
    const std::uint32_t first = side > 0.0 ? 0 : 3;
    for (std::uint32_t i = first; i < first + 3; ++i) {
      const glm::dvec2 corner = turned.seen(turned.sim.position(PointId{i}));
      EXPECT_EQ(pick_point(turned.snapshot(), turned.lens_with_surface(), corner, reach), PointId{i}) << side;
    }
  }
}

TEST(Pick, AColliderInFrontHidesTheSurface) {
  Layers layers;
  const glm::dvec2 cursor = layers.seen({0.1, -0.2, 0.0});
  layers.sim.system.colliders = {{.shape = Sphere{Vec3(0.1, -0.2, 0.0) + 0.5 * layers.camera.back, 0.2}}};
  EXPECT_FALSE(pick_surface(layers.snapshot(), layers.view_transform(), cursor));
}

TEST(Selection, ContainsEachIdOnceInOrder) {
  Selection selection;
  for (const std::uint32_t id : {5u, 2u, 9u}) selection.toggle(PointId{id});
  EXPECT_EQ(selection.points, (std::vector{PointId{2}, PointId{5}, PointId{9}}));
  EXPECT_TRUE(selection.contains(PointId{5}));
  selection.toggle(PointId{5});
  EXPECT_FALSE(selection.contains(PointId{5}));
  selection.add({{PointId{2}, PointId{3}}, {SpringId{1}}});
  EXPECT_EQ(selection.points, (std::vector{PointId{2}, PointId{3}, PointId{9}}));
}

TEST(Selection, DropsRemovedItems) {
  TestSim sim;
  const PointId a = sim.add({0.0, 0.0, 0.0}), b = sim.add({1.0, 0.0, 0.0});
  const SpringId spring = sim.join(a, b, 1.0, 1.0);
  const Selection all = select_all(sim.system);
  sim.system.set_springs({});
  EXPECT_EQ(existing_part_of(sim.system, all), (Selection{{a, b}, {}}));
  EXPECT_EQ(all.springs, std::vector{spring});
}

}  // namespace
}  // namespace hooke
