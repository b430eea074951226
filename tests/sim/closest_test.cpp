// The narrow phase of contact between faces: closest points, parts of paths free of contact, and the independent count of crossings.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "sim/contact/closest.h"
#include "sim/contact/surface/surface_tree.h"
#include "support/crossings.h"
#include "support/folds.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

Vec3 anywhere(Random& random) {
  const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0), z = random.uniform(-1.0, 1.0);
  return {x, y, z};
}

FourPoints four_anywhere(Random& random) { return {anywhere(random), anywhere(random), anywhere(random), anywhere(random)}; }

// Random weights of the closest points of both features.
std::array<double, 4> any_weights(FeaturePair kind, Random& random) {
  const double s = random.uniform(0.0, 1.0), t = random.uniform(0.0, 1.0);
  if (kind == FeaturePair::TwoEdges) return {1.0 - s, s, -(1.0 - t), -t};
  const bool flips = s + t > 1.0;
  const double u = flips ? 1.0 - s : s, v = flips ? 1.0 - t : t;
  return {1.0, -(1.0 - u - v), -u, -v};
}

double distance_at(const FourPoints& x, const std::array<double, 4>& w) {
  return glm::length(w[0] * x[0] + w[1] * x[1] + w[2] * x[2] + w[3] * x[3]);
}

TEST(ClosestPoints, AreOnBothFeaturesAndNoOthersAreCloser) {
  Random random(1);
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges})
    for (int i = 0; i < 300; ++i) {
      FourPoints x = four_anywhere(random);
      // parallel edges, and faces without area
      if (i % 10 == 0) x[3] = x[2] + 0.7 * (x[1] - x[0]);
      if (i % 10 == 1) x[3] = 0.5 * (x[1] + x[2]);
      const Closest closest = closest_points(kind, x);
      EXPECT_NEAR(closest.distance, distance_at(x, closest.weight), 1e-15);
      const auto& w = closest.weight;
      const int first = kind == FeaturePair::PointFace ? 1 : 2;
      double sum = 0.0;
      for (int c = 0; c < 4; ++c) {
        EXPECT_GE(c < first ? w[c] : -w[c], 0.0);
        sum += std::abs(w[c]);
      }
      EXPECT_NEAR(sum, 2.0, 1e-14);
      for (int k = 0; k < 300; ++k) ASSERT_GE(distance_at(x, any_weights(kind, random)), closest.distance - 1e-14);
    }
}

// Blocks of any size; some features are degenerate, and some pairs have a point in common.
TEST(FeatureBlock, HasTheClosestPointsOfEachOfItsPairsBitForBit) {
  Random random(3);
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges})
    for (int count = 1; count <= FeatureBlock::capacity; ++count) {
      std::vector<Vec3> x(80);
      for (Vec3& point : x) point = anywhere(random);
      for (int c = 0; c < 20; ++c) x[60 + c] = c % 2 == 0 ? x[c] : 0.5 * (x[c] + x[c + 20]);
      FeatureBlock block;
      block.count = count;
      for (int i = 0; i < count; ++i)
        for (Index& point : block.points[i]) point = std::min<Index>(79, static_cast<Index>(random.uniform(0.0, 80.0)));
      find_closest(kind, x, block);
      for (int i = 0; i < count; ++i) {
        const auto& p = block.points[i];
        const Closest one = closest_points(kind, {x[p[0]], x[p[1]], x[p[2]], x[p[3]]}), many = block.closest(i);
        ASSERT_EQ(many.distance, one.distance);
        ASSERT_EQ(many.separation, one.separation);
        ASSERT_EQ(many.weight, one.weight);
        ASSERT_EQ(many.is_at_end, one.is_at_end);
      }
    }
}

TEST(FreePart, KeepsAHundredthOfTheDistanceAndEndsOnlyWhereItComesCloser) {
  Random random(2);
  int hits = 0;
  long steps = 0;
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges})
    for (int i = 0; i < 500; ++i) {
      const FourPoints x = four_anywhere(random), displacement = four_anywhere(random);
      const double distance = closest_points(kind, x).distance, part = free_part(kind, x, displacement, distance, steps);
      const auto distance_after = [&](double t) {
        FourPoints at = x;
        for (int c = 0; c < 4; ++c) at[c] += t * displacement[c];
        return closest_points(kind, at).distance;
      };
      for (int k = 0; k <= 100; ++k) ASSERT_GT(distance_after(part * k / 100.0), (part < 1.0 ? 0.0999 : 0.0099) * distance);
      if (part == 1.0) continue;
      ++hits;
      double closest = distance;
      for (int k = 0; k <= 20000; ++k) closest = std::min(closest, distance_after(part + (1.0 - part) * k / 20000.0));
      EXPECT_LT(closest, 0.12 * distance);
    }
  EXPECT_GT(hits, 50);
}

// Of random faces, by both counts.
TEST(Crossings, AreThoseOfTheIndependentCount) {
  Random random(3);
  TestSim sim;
  std::vector<PointId> ids;
  for (int i = 0; i < 60; ++i) ids.push_back(sim.add(anywhere(random)));
  for (int i = 0; i < 60; i += 3) sim.system.faces.push_back({{ids[i], ids[i + 1], ids[i + 2]}});
  sim.system.contact.faces = true;
  const SurfacePlan plan = plan_surface(sim.system);
  SurfaceTree tree;
  tree.build(plan, sim.state.position);
  const long count = CrossingCounter(sim.system).count(sim.state.position);
  EXPECT_GT(count, 20);
  EXPECT_EQ(static_cast<long>(tree.find_crossings(plan, sim.state.position).found.size()), count);
}

// A flat sheet in any direction does not pass through itself by rounding.
TEST(Crossings, AreNotFoundInFlatSheets) {
  Random random(6);
  for (int k = 0; k < 20; ++k) {
    TestSim sim;
    const Vec3 place = 10.0 * anywhere(random), across = anywhere(random), down = anywhere(random);
    folds::add_sheet(
        sim, 9, [&](double u, double v) { return place + u * across + v * down; }, folds::at_rest);
    sim.system.contact.faces = true;
    const SurfacePlan plan = plan_surface(sim.system);
    SurfaceTree tree;
    tree.build(plan, sim.state.position);
    EXPECT_TRUE(tree.find_crossings(plan, sim.state.position).found.empty());
  }
}

// All pairs, by brute force.
TEST(SurfaceTree, FindsAllPairsWithinReachOnce) {
  Random random(4);
  TestSim sim;
  std::vector<PointId> ids;
  for (int i = 0; i < 90; ++i) ids.push_back(sim.add(2.0 * anywhere(random)));
  for (int i = 0; i + 2 < 90; i += 2) sim.system.faces.push_back({{ids[i], ids[i + 1], ids[i + 2]}});
  // spheres
  for (int i = 0; i < 12; ++i) {
    const PointId id = sim.add(2.0 * anywhere(random));
    sim.system.point(sim.system.index_of(id)).radius = random.uniform(0.0, 0.3);
  }
  sim.system.contact.faces = true;
  const SurfacePlan plan = plan_surface(sim.system);
  const std::vector<Vec3>& x = sim.state.position;
  for (const double reach : {0.01, 0.3, 10.0}) {
    std::size_t expected = 0;
    for (const Index p : plan.corners)
      for (const SurfacePiece& piece : plan.pieces) {
        const auto& [a, b, c] = piece.points;
        if (!piece.is_face || p == a || p == b || p == c) continue;
        if (closest_points(FeaturePair::PointFace, {x[p], x[a], x[b], x[c]}).distance - plan.radius_of({p, a, b, c}) < reach) ++expected;
      }
    for (std::size_t e = 0; e < plan.edges.size(); ++e)
      for (std::size_t f = 0; f < e; ++f) {
        const auto [a, b] = plan.edges[e];
        const auto [c, d] = plan.edges[f];
        if (plan.excludes_edge(static_cast<Index>(e), static_cast<Index>(f))) continue;
        if (a != c && a != d && b != c && b != d &&
            closest_points(FeaturePair::TwoEdges, {x[a], x[b], x[c], x[d]}).distance - plan.radius_of({a, b, c, d}) < reach)
          ++expected;
      }
    SurfaceTree tree;
    tree.build(plan, x);
    SurfacePairs pairs;
    EXPECT_TRUE(tree.find_pairs(plan, x, reach, std::vector<LeftOut>(x.size()), 1'000'000, pairs));
    EXPECT_EQ(pairs[0].size() + pairs[1].size(), expected) << reach;
  }
}

}  // namespace
}  // namespace hooke
