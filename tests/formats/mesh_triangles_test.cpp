// Polygons with many corners, split into triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <set>

#include "formats/mesh/triangulate.h"

namespace hooke {
namespace {

using Polygon = std::vector<Vec3>;

double area_of_outline(const Polygon& polygon) {
  Vec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return 0.5 * glm::length(sum);
}

struct Result {
  bool is_simple;
  double area = 0.0, smallest = 1e300;
  std::set<Index> corners;
  std::size_t triangles = 0;
};

Result split(const Polygon& polygon) {
  std::vector<std::array<Index, 3>> triangles;
  Result result{.is_simple = triangulate(polygon, triangles)};
  for (const auto& t : triangles) {
    const double area = 0.5 * glm::length(glm::cross(polygon[t[1]] - polygon[t[0]], polygon[t[2]] - polygon[t[0]]));
    result.area += area;
    result.smallest = std::min(result.smallest, area);
    result.corners.insert(t.begin(), t.end());
  }
  result.triangles = triangles.size();
  return result;
}

// In a plane that is parallel to no axis, scaled, far from the origin.
Polygon placed(const Polygon& flat, double angle, double scale) {
  const Vec3 u = glm::normalize(Vec3(1.0, std::cos(angle), 0.3)), v = glm::normalize(glm::cross(u, Vec3(0.1, 0.2, std::sin(angle) + 2.0)));
  Polygon polygon;
  for (const Vec3& x : flat) polygon.push_back(scale * (x.x * u + x.y * v) + Vec3(0.3, -0.7, 0.2));
  return polygon;
}

// Starting at every corner, in both directions, in several planes.
void expect_covered(const Polygon& flat) {
  for (int plane = 0; plane < 4; ++plane)
    for (const bool reversed : {false, true})
      for (std::size_t first = 0; first < flat.size(); ++first) {
        Polygon polygon = plane == 0 ? flat : placed(flat, plane, std::pow(10.0, plane - 2));
        if (reversed) std::reverse(polygon.begin(), polygon.end());
        std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(first), polygon.end());
        const double area = area_of_outline(polygon);
        const Result result = split(polygon);
        EXPECT_TRUE(result.is_simple) << plane << reversed << first;
        EXPECT_EQ(result.triangles, polygon.size() - 2) << plane << reversed << first;
        EXPECT_EQ(result.corners.size(), polygon.size()) << plane << reversed << first;
        EXPECT_NEAR(result.area / area, 1.0, 1e-12) << plane << reversed << first;
        EXPECT_GT(result.smallest, 1e-6 * area) << plane << reversed << first;
      }
}

TEST(Triangulate, CoversConcavePolygonsWhicheverCornerComesFirst) {
  expect_covered({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
  expect_covered({{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {5, 4, 0}, {5, 1, 0}, {3, 1, 0}, {3, 4, 0}, {2, 4, 0}, {2, 1, 0}, {0, 1, 0}});
  expect_covered({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {1, 3, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {2.2, 2, 0}, {2.2, 0.8, 0}, {0, 0.8, 0}});
}

TEST(Triangulate, UsesCornersOnStraightSides) {
  expect_covered({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0}, {1.5, 3, 0}, {0, 3, 0}, {0, 1, 0}});
  expect_covered({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}});
}

TEST(Triangulate, CoversARingWhoseHoleIsJoinedByABridge) {
  // the outer square, across the bridge, the hole in the other direction, and back
  expect_covered({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}});
  // two holes from the same corner
  expect_covered({{0, 0, 0},
                  {8, 0, 0},
                  {8, 4, 0},
                  {0, 4, 0},
                  {0, 0, 0},
                  {1, 2, 0},
                  {1, 3, 0},
                  {2, 3, 0},
                  {1, 2, 0},
                  {0, 0, 0},
                  {4, 1, 0},
                  {5, 3, 0},
                  {6, 1, 0},
                  {4, 1, 0}});
}

TEST(Triangulate, CoversRandomStarsAndCombs) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  for (int trial = 0; trial < 12; ++trial) {
    Polygon star;
    const int corners = 5 + trial * 3;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners, r = radius(random);
      star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    expect_covered(star);
  }
}

TEST(Triangulate, EndsWithAnyPolygon) {
  EXPECT_LE(split(Polygon(5, Vec3(1.0))).triangles, 3u);
  EXPECT_LE(split({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).triangles, 3u);
  EXPECT_EQ(split({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {6, 6, 0}, {4, 4, 0}, {0, 4, 0}}).area, 16.0);  // a spike
  std::mt19937_64 random(3);
  Polygon tangle;
  for (int i = 0; i < 1000; ++i) tangle.emplace_back(static_cast<double>(random() % 100), static_cast<double>(random() % 100), 0.0);
  EXPECT_FALSE(split(tangle).is_simple);
}

}  // namespace
}  // namespace hooke
