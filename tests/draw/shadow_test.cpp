// Soft shadows: the shadow map, and its appearance on the ground, a ball and a box.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "draw/parts/soft_shadow_map.h"
#include "support/picture.h"

namespace hooke {
namespace {

// The shadow of a horizontal square sheet of side 1 m at `height` above the center of a map of 4 m; rows of 80 texels.
std::vector<std::uint8_t> shade_of_sheet(float height) {
  SoftShadowMap map;
  map.begin({-2.0f, -2.0f}, {2.0f, 2.0f}, 80);
  const glm::vec3 a(-0.5f, -0.5f, height), b(0.5f, -0.5f, height), c(0.5f, 0.5f, height), d(-0.5f, 0.5f, height);
  map.add_triangle(a, b, c);
  map.add_triangle(a, c, d);
  return map.finish();
}

int at_column(const std::vector<std::uint8_t>& values, int column) { return values[40 * 80 + column]; }

// The number of texels of the middle row over which the shadow falls from 90 % to 10 % of its value at the center.
int edge(const std::vector<std::uint8_t>& values) {
  int count = 0;
  for (int i = 40; i < 80; ++i) {
    const double fraction = double(at_column(values, i)) / at_column(values, 40);
    count += fraction < 0.9 && fraction > 0.1;
  }
  return count;
}

TEST(SoftShadowMap, IsSofterAndPalerTheHigherTheObject) {
  int darkest = 256, softest = -1;
  for (const float height : {0.0f, 0.3f, 0.8f, 1.4f}) {
    const auto values = shade_of_sheet(height);
    EXPECT_LE(at_column(values, 40), darkest) << height;
    EXPECT_GE(edge(values), softest) << height;
    darkest = at_column(values, 40);
    softest = edge(values);
  }
  EXPECT_GT(at_column(shade_of_sheet(0.0f), 40), 190);
  EXPECT_LE(edge(shade_of_sheet(0.0f)), 4);
  EXPECT_GT(edge(shade_of_sheet(0.8f)), 6);
  EXPECT_LT(at_column(shade_of_sheet(4.0f), 40), 40);
}

TEST(SoftShadowMap, OfAnObjectOnTheGroundHasItsOutline) {
  const auto values = shade_of_sheet(0.0f);  // from the 30th texel to the 50th
  for (const int inside : {33, 40, 46}) EXPECT_GT(at_column(values, inside), 190) << inside;
  for (const int outside : {0, 20, 26, 53, 60, 79}) EXPECT_EQ(at_column(values, outside), 0) << outside;
}

TEST(SoftShadowMap, DoesNotDependOnTheTriangulationOfASheet) {
  SoftShadowMap whole, cut;
  for (SoftShadowMap* map : {&whole, &cut}) map->begin({-1.0f, -1.0f}, {1.0f, 1.0f}, 100);
  const auto add = [](SoftShadowMap& map, float x, float size) {
    for (float y = -0.5f; y < 0.49f; y += size) {
      const glm::vec3 a(x, y, 0.2f), b(x + size, y, 0.2f), c(x + size, y + size, 0.2f), d(x, y + size, 0.2f);
      map.add_triangle(a, b, c);
      map.add_triangle(a, c, d);
    }
  };
  add(whole, -0.5f, 1.0f);
  for (float x = -0.5f; x < 0.49f; x += 0.025f) add(cut, x, 0.025f);
  const auto one = whole.finish(), other = cut.finish();
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], other[i], 12) << i;
}

TEST(SoftShadowMap, IgnoresNonFiniteAndDistantTriangles) {
  SoftShadowMap map;
  const float nowhere = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
  map.begin({-1.0f, -1.0f}, {1.0f, 1.0f}, 32);
  for (const glm::vec3& place : {glm::vec3(nowhere), glm::vec3(0.0f, 0.0f, nowhere), glm::vec3(infinite), glm::vec3(0.0f, 0.0f, infinite),
                                 glm::vec3(0.0f, 0.0f, -0.1f), glm::vec3(5.0f, 0.0f, 0.0f), glm::vec3(1e30f, 0.0f, 0.0f)}) {
    map.add(place, 1.0f);
    map.add_line(place, place + glm::vec3(0.1f, 0.0f, 0.0f), 0.1f);
    map.add_triangle(place, place + glm::vec3(0.1f, 0.0f, 0.0f), place + glm::vec3(0.0f, 0.1f, 0.0f));
  }
  const auto& values = map.finish();
  EXPECT_TRUE(std::ranges::all_of(values, [](std::uint8_t value) { return value == 0; }));
}

// A horizontal sheet of side 1 m at `height` above the plane y = 0.
TestSim sheet_over_floor(double height) {
  TestSim scene;
  for (const Vec3& corner : {Vec3(-0.5, 0.0, -0.5), Vec3(-0.5, 0.0, 0.5), Vec3(0.5, 0.0, 0.5), Vec3(0.5, 0.0, -0.5)})
    scene.add(corner + Vec3(0.0, height, 0.0));
  scene.system.faces = std::vector<Face>{{{PointId{0}, PointId{1}, PointId{2}}}, {{PointId{0}, PointId{2}, PointId{3}}}};
  scene.system.colliders = {{.shape = Plane{}}};
  return scene;
}

Camera camera_from(const Vec3& eye) { return make_camera({.camera = CameraPose{.eye = eye, .target = Vec3(0.0)}}, System{}, State{}, 1.6); }

// From the side and slightly above, so that the floor under the sheet is visible.
const Vec3 aside(0.0, 0.9, 4.0);
constexpr int width = 480, height = 300;

// The reduction in brightness by shadows at a position, in percent.
int shade_at(const TestSim& scene, const Vec3& place, ViewOptions options = {}, const Vec3& eye = aside) {
  options.grid = false;
  const Camera camera = camera_from(eye);
  const int with = brightness(at(draw(scene, {}, camera, options, width, height), camera, place));
  options.shadows = false;
  const int without = brightness(at(draw(scene, {}, camera, options, width, height), camera, place));
  return 100 - 100 * with / without;
}

TEST(Shadow, IsUnderASheetAndPalerTheHigherTheSheet) {
  const Vec3 under(0.3, 0.0, 0.2);
  const int low = shade_at(sheet_over_floor(0.4), under), high = shade_at(sheet_over_floor(1.2), under);
  EXPECT_GT(low, 20);
  EXPECT_LT(high, low - 5);
  EXPECT_GT(high, 5);
  EXPECT_LT(shade_at(sheet_over_floor(0.4), {1.9, 0.0, 0.0}), 2);
}

TEST(Shadow, IsDrawnInTheLightThemeToo) {
  const int shade = shade_at(sheet_over_floor(0.4), {0.3, 0.0, 0.2}, {.background = {246, 247, 249}});
  EXPECT_GT(shade, 15);
  EXPECT_LT(shade, 50);
}

TEST(Shadow, IsDrawnWithAndWithoutMultisampling) {
  for (const int samples : {0, 4}) EXPECT_GT(shade_at(sheet_over_floor(0.4), {0.3, 0.0, 0.2}, {.samples = samples}), 20) << samples;
}

TEST(Shadow, IsCastOnlyByVisibleItems) {
  TestSim net = sheet_over_floor(0.15);
  net.join(PointId{1}, PointId{2}, 100.0, 1.0);
  for (Index i = 0; i < 4; ++i) net.system.point(i).radius = 0.06;
  const Vec3 under_spring(0.1, 0.0, 0.5), under_point(0.5, 0.0, 0.5), under_sheet(0.0, 0.0, 0.42);
  const Vec3 low_eye(0.0, 0.25, 4.0);
  const auto shade = [&](const Vec3& place, bool points, bool springs, bool surface) {
    return shade_at(net, place, {.points = points, .springs = springs, .surface = surface}, low_eye);
  };
  EXPECT_GT(shade(under_sheet, false, false, true), 15);
  EXPECT_GT(shade(under_spring, false, true, false), 4);
  EXPECT_GT(shade(under_point, true, false, false), 4);
  EXPECT_EQ(shade(under_sheet, false, false, false), 0);
}

TEST(Shadow, OfABallFallsOnTheFloorAndOfASheetOnTheBall) {
  TestSim scene = sheet_over_floor(1.1);
  scene.system.colliders.push_back({.shape = Sphere{{0.0, 0.5, 0.0}, 0.4}});
  const Vec3 on_ball = Vec3(0.0, 0.5, 0.0) + 0.4 * glm::normalize(Vec3(0.0, 0.8, 1.0));
  EXPECT_GT(shade_at(scene, on_ball), 10);
  scene.system.faces.clear();
  EXPECT_LT(shade_at(scene, on_ball), 1);
  EXPECT_GT(shade_at(scene, {0.0, 0.0, 0.3}), 15);
}

TEST(Shadow, FallsOnTheTopOfABoxAndEndsAtItsEdge) {
  TestSim scene = sheet_over_floor(0.5);
  scene.system.colliders = {{.shape = Box{{-0.5, -1.0, -1.0}, {0.1, 0.0, 1.0}}}};
  EXPECT_GT(shade_at(scene, {-0.2, 0.0, 0.3}), 15);
  EXPECT_EQ(shade_at(scene, {0.3, 0.0, 0.3}), 0);  // in the air
}

TEST(Shadow, IsAbsentWhereNothingIsNear) {
  const Camera camera = camera_from(aside);
  const auto both = [&](const TestSim& scene) {
    return std::pair(draw(scene, {}, camera, {}, width, height).pixels, draw(scene, {}, camera, {.shadows = false}, width, height).pixels);
  };
  TestSim scene = sheet_over_floor(60.0);
  const auto far = both(scene);
  EXPECT_TRUE(far.first == far.second);

  scene = sheet_over_floor(0.3);
  scene.system.colliders[0].solid = false;
  const auto thin = both(scene);
  EXPECT_TRUE(thin.first == thin.second);

  scene.system.colliders.clear();
  const auto bare = both(scene);
  EXPECT_TRUE(bare.first == bare.second);
}

TEST(Shadow, IsUnaffectedByPointsAtNonFinitePositions) {
  TestSim scene = sheet_over_floor(0.4);
  const Camera camera = camera_from(aside);
  const Image valid = draw(scene, {}, camera, {}, width, height);
  for (const double nowhere : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
    TestSim broken = scene;
    broken.add(Vec3(nowhere));
    EXPECT_LE(difference(draw(broken, {}, camera, {}, width, height), valid), 0.0005) << nowhere;
  }
}

}  // namespace
}  // namespace hooke
