// Pictures drawn without a display.
#include <gtest/gtest.h>
#include <imgui.h>

#include <cstdlib>
#include <limits>
#include <set>

#include "base/errors.h"
#include "support/picture.h"

namespace hooke {
namespace {

constexpr Color background{32, 36, 40};
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// A wavy net of 6 x 6 points, nailed at two corners, with faces.
TestSim wavy_net(const Vec3& origin = Vec3(0.0)) {
  TestSim net;
  std::vector<PointId> ids;
  constexpr int n = 6;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 place = origin + Vec3(0.2 * j - 0.5, 0.5 - 0.2 * i, 0.125 * ((i + j) % 3));
      ids.push_back(i == 0 && j % (n - 1) == 0 ? net.nail(place) : net.add(place));
      net.system.point(net.system.index_of(ids.back())).radius = 0.02;
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int at = i * n + j;
      if (j + 1 < n) net.join(ids[at], ids[at + 1], 100.0, 0.24);
      if (i + 1 < n) net.join(ids[at], ids[at + n], 100.0, 0.22);
      if (i + 1 == n || j + 1 == n) continue;
      net.system.faces.push_back({{ids[at], ids[at + n], ids[at + 1]}});
      net.system.faces.push_back({{ids[at + 1], ids[at + n], ids[at + n + 1]}});
    }
  return net;
}

// Every kind of item that is drawn, in 3-D.
TestSim spatial_scene() {
  TestSim scene = wavy_net();
  scene.system.colliders = {{Plane{{0.0, -0.8, 0.0}, {0.0, 1.0, 0.0}}},
                            {Sphere{{0.7, -0.5, 0.4}, 0.3}},
                            {Box{{-1.0, -0.8, 0.2}, {-0.7, -0.5, 0.5}}},
                            {.shape = Sphere{{1.0, 0.4, -0.5}, 0.25}, .solid = false},
                            {.shape = Box{{-1.3, 0.0, -0.6}, {-0.9, 0.4, -0.2}}, .solid = false}};
  return scene;
}

TestSim flat_scene() {
  TestSim scene;
  scene.system.dimensions = 2;
  const PointId pink = scene.nail({0.0, 0.5, 0.0}), yellow = scene.add({0.5, 0.5, 0.0}), plain = scene.add({-0.4, 0.1, 0.0});
  scene.system.point(0).color = Color{255, 105, 180};
  scene.system.point(1).color = Color{255, 255, 0};
  for (Index i = 0; i < 3; ++i) scene.system.point(i).radius = 0.04;
  scene.join(pink, yellow, 100.0, 0.4);
  scene.join(pink, plain, 100.0, 0.7);
  scene.system.colliders = {{.shape = Plane{{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, .solid = false},
                            {Plane{{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}},
                            {Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}},
                            {Sphere{{-0.4, -0.5, 0.0}, 0.2}},
                            {Box{{0.3, -1.0, -1.0}, {0.6, -0.6, 1.0}}}};
  return scene;
}

Marks marks_on(const TestSim& scene) {
  const auto& points = scene.system.points();
  return {.selected_points = {points[1].id, points[0].id},
          .selected_springs = {scene.system.springs()[0].id},
          .hovered_point = points[2].id,
          .hovered_spring = scene.system.springs()[1].id,
          .ghost_point = Vec3(0.2, -0.2, 0.0),
          .ghost_spring = std::pair(scene.state.position[2], Vec3(0.2, -0.2, 0.0))};
}

Camera camera_on(const TestSim& scene, double aspect) { return make_camera({}, scene.system, scene.state, aspect); }

// A picture must equal the golden picture. One that does not is written to the working folder of the test.
void expect_golden(const Image& image, const std::string& name) {
  const double different = difference(image, read_png(std::filesystem::path(HOOKE_GOLDEN_PICTURES) / name));
  if (different > 0.001) write_png(image, "not_" + name);
  EXPECT_LE(different, 0.001) << "see not_" << name;
}

TEST(Picture, OfA3DSceneMatchesTheGoldenPicture) {
  const TestSim scene = spatial_scene();
  expect_golden(draw(scene, marks_on(scene), camera_on(scene, 1.6), {}, 480, 300), "spatial.png");
}

TEST(Picture, OfAFlatSceneMatchesTheGoldenPicture) {
  const TestSim scene = flat_scene();
  expect_golden(draw(scene, marks_on(scene), camera_on(scene, 1.6), {}, 480, 300), "flat.png");
}

TEST(Picture, OnALightBackgroundMatchesTheGoldenPicture) {
  const TestSim scene = flat_scene();
  expect_golden(draw(scene, marks_on(scene), camera_on(scene, 1.6), {.background = {250, 250, 250}}, 480, 300), "light.png");
}

TEST(Picture, OfAnEmptySceneIsTheBackground) {
  const TestSim empty;
  const Image image = draw(empty, {}, camera_on(empty, 1.0), {.grid = false}, 16, 16);
  ASSERT_EQ(image.pixels.size(), 3u * 16 * 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) EXPECT_EQ(at(image, x, y), background);
}

TEST(Picture, CanHaveAnySizeFromOnePixelTo4096) {
  const TestSim scene = spatial_scene();
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(4096, 1), std::pair(3, 700), std::pair(4096, 4096)}) {
    const Image image = draw(scene, marks_on(scene), camera_on(scene, double(width) / height), {}, width, height);
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.pixels.size(), std::size_t(3) * width * height);
  }
}

TEST(Picture, IsTheSameFarFromTheOrigin) {
  const Vec3 far(1e5, 2e5, -1e5);
  const TestSim here = wavy_net(), there = wavy_net(far);
  const Camera near_camera = camera_on(here, 1.6);
  Camera far_camera = near_camera;
  far_camera.target += far;
  ViewOptions options;
  options.grid = false;  // the grid passes through the origin
  const Image expected = draw(here, {}, near_camera, options, 480, 300);
  EXPECT_LE(difference(draw(there, {}, far_camera, options, 480, 300), expected), 0.0005);
}

TEST(Picture, KeepsTheGroundFarFromTheOrigin) {
  const Vec3 far(1e5, 0.0, -2e5);
  TestSim here = wavy_net(), there = wavy_net(far);
  here.system.colliders = {{Plane{{0.0, -0.8, 0.0}, {0.0, 1.0, 0.0}}}};
  there.system.colliders = here.system.colliders;
  const Camera near_camera = camera_on(here, 1.6);
  Camera far_camera = near_camera;
  far_camera.target += far;
  EXPECT_LE(difference(draw(there, {}, far_camera, {}, 480, 300), draw(here, {}, near_camera, {}, 480, 300)), 0.0005);
}

// The same scene with and without points at non-finite positions that are connected to the rest.
TEST(Picture, IgnoresPointsAtNonFinitePositions) {
  const double places[] = {not_a_number, std::numeric_limits<double>::infinity(), -1e300, 1e40};
  for (const double nowhere : places) {
    const TestSim valid = wavy_net();
    TestSim broken = wavy_net();
    const PointId lost = broken.add({nowhere, nowhere, 0.0});
    broken.system.faces.push_back({{lost, PointId{0}, PointId{1}}});
    Marks marks{.selected_points = {lost}, .hovered_point = lost, .ghost_point = Vec3(nowhere)};
    if (!std::isfinite(nowhere)) {
      const SpringId spring = broken.join(lost, PointId{0}, 100.0, 1.0);
      marks.selected_springs = {spring};
      marks.hovered_spring = spring;
      marks.ghost_spring = std::pair(Vec3(nowhere), Vec3(0.0));
    }
    const Camera camera = camera_on(valid, 1.6);
    EXPECT_EQ(draw(broken, marks, camera, {}, 320, 200).pixels, draw(valid, {}, camera, {}, 320, 200).pixels) << nowhere;
  }
}

TEST(Picture, IsUnaffectedByAViewFromInside) {
  const TestSim scene = spatial_scene();
  for (const double distance : {0.01, 0.3, 1.0}) {
    Camera camera = camera_on(scene, 1.6);
    camera.distance = distance;
    const Image image = draw(scene, marks_on(scene), camera, {}, 160, 100);
    EXPECT_EQ(image.width, 160);
  }
}

bool is_red(const Color& color) { return color.red > 150 && color.green < 110 && color.blue < 110; }
bool is_yellow(const Color& color) { return color.red > 150 && color.green > 110 && color.blue < 110; }

TestSim two_points() {
  TestSim scene;
  scene.system.dimensions = 2;
  scene.nail({-0.5, 0.0, 0.0});
  scene.add({0.5, 0.0, 0.0});
  for (Index i = 0; i < 2; ++i) scene.system.point(i).radius = 0.1;
  return scene;
}

TEST(Picture, ShowsNailsAsYellowSquares) {
  const TestSim scene = two_points();
  const Camera camera = camera_on(scene, 1.6);
  const Image image = draw(scene, {}, camera, {.grid = false}, 480, 300);
  EXPECT_TRUE(is_yellow(at(image, camera, {-0.5, 0.0, 0.0})));
  EXPECT_TRUE(is_yellow(at(image, camera, {-0.42, 0.08, 0.0})));  // the corner of a square, outside a disc
  EXPECT_FALSE(is_yellow(at(image, camera, {0.5, 0.0, 0.0})));
  EXPECT_EQ(at(image, camera, {0.58, 0.08, 0.0}), background);
}

TEST(Picture, ShowsTheColorOfAPointOnlyWhileItIsNotNailed) {
  TestSim scene = two_points();
  scene.system.point(0).color = Color{0, 0, 255};
  const Camera camera = camera_on(scene, 1.6);
  const auto seen = [&] { return at(draw(scene, {}, camera, {}, 480, 300), camera, {-0.5, 0.0, 0.0}); };
  EXPECT_TRUE(is_yellow(seen()));
  scene.system.point(0).nailed = false;
  EXPECT_GT(seen().blue, 150);
  EXPECT_LT(seen().red, 60);
}

TEST(Picture, ShowsSelectedPointsInRed) {
  const TestSim scene = two_points();
  const Camera camera = camera_on(scene, 1.6);
  const Image image = draw(scene, {.selected_points = {PointId{0}, PointId{1}}}, camera, {}, 480, 300);
  EXPECT_TRUE(is_red(at(image, camera, {0.5, 0.0, 0.0})));

  // a nail stays yellow inside a red ring
  EXPECT_TRUE(is_yellow(at(image, camera, {-0.5, 0.0, 0.0})));
  const Vec3 middle = camera.project({-0.5, 0.0, 0.0}, {480, 300});
  const double radius = 0.1 / camera.meters_per_pixel({-0.5, 0.0, 0.0}, {480, 300});
  EXPECT_TRUE(is_red(at(image, static_cast<int>(middle.x), static_cast<int>(middle.y + radius + 2.0))));
}

TEST(Picture, ShowsStrainInBlueAndOrange) {
  for (const double rest : {0.5, 2.0}) {
    TestSim scene = two_points();
    scene.join(PointId{0}, PointId{1}, 100.0, rest);
    const Camera camera = camera_on(scene, 1.6);
    const Color seen = at(draw(scene, {}, camera, {.grid = false}, 480, 300), camera, Vec3(0.0));
    const int more_red = seen.red - seen.blue;
    EXPECT_GT(rest < 1.0 ? more_red : -more_red, 50);
  }
}

TEST(Picture, DrawsSpringsAtTheLineWidthOfTheScreenScale) {
  TestSim scene = two_points();
  scene.join(PointId{0}, PointId{1}, 100.0, 1.0);
  const Camera camera = camera_on(scene, 1.6);
  for (const double scale : {1.0, 2.0, 4.0}) {
    const Image image = draw(scene, {}, camera, {.grid = false, .scale = scale}, 480, 300);
    double covered = 0.0;  // [px], in the column through the center
    for (int y = 0; y < 300; ++y) covered += (at(image, 240, y).blue - 40.0) / (150.0 - 40.0);
    EXPECT_NEAR(covered, 1.75 * scale, 0.1 * scale);
  }
}

TEST(Picture, DrawsSpringsEquallyWideAtAnySlopeWithAndWithoutMultisampling) {
  for (const int samples : {0, 4})
    for (const double scale : {1.0, 2.0})
      for (const double degrees : {0.0, 9.0, 30.0, 45.0, 77.0, 90.0}) {
        const double angle = degrees * 3.14159265358979 / 180.0;
        TestSim scene;
        scene.system.dimensions = 2;
        const Vec3 half = 0.4 * Vec3(std::cos(angle), std::sin(angle), 0.0);
        scene.join(scene.add(-half), scene.add(half), 100.0, 0.8);
        const Camera camera = make_camera({.camera = CameraPose{.orthographic = true}}, scene.system, scene.state, 1.6);
        const ViewOptions options{.points = false, .grid = false, .samples = samples, .scale = scale};
        const Image image = draw(scene, {}, camera, options, 480, 300);
        double covered = 0.0;  // [px]
        std::set<int> shades;
        for (int y = 0; y < 300; ++y)
          for (int x = 0; x < 480; ++x) {
            covered += (at(image, x, y).blue - 40.0) / (150.0 - 40.0);
            shades.insert(at(image, x, y).blue);
          }
        const double length = 0.8 / camera.meters_per_pixel(Vec3(0.0), {480, 300});
        EXPECT_NEAR(covered / length, 1.75 * scale, 0.12 * scale) << degrees << ", " << samples << " samples";
        const bool is_slanted = degrees > 0.0 && degrees < 90.0 && degrees != 45.0;
        EXPECT_GT(shades.size(), is_slanted ? 12u : 1u) << degrees;  // its edges are antialiased
      }
}

// A near spring over a far one along almost the same line, in both orders: no gap of background between them.
TEST(Picture, BlendsTheEdgeOfANearSpringWithTheFarOne) {
  const auto picture = [](bool near_first) {
    TestSim scene;
    const auto add = [&](double z, double rise) {
      const PointId a = scene.add({-0.5, -rise, z});
      scene.join(a, scene.add({0.5, rise, z}), 100.0, std::hypot(1.0, 2.0 * rise));
    };
    add(near_first ? 0.1 : -0.1, near_first ? 0.02 : 0.0);
    add(near_first ? -0.1 : 0.1, near_first ? 0.0 : 0.02);
    const Camera camera = make_camera({.camera = CameraPose{.eye = {0.0, 0.0, 2.0}, .orthographic = true}}, scene.system, scene.state, 1.6);
    return draw(scene, {}, camera, {.points = false, .grid = false}, 480, 300);
  };
  EXPECT_TRUE(picture(true).pixels == picture(false).pixels);
}

TEST(Picture, AntialiasesPolygonsByMultisampling) {
  TestSim scene;
  for (const Vec3& corner : {Vec3(-0.5, -0.4, 0.0), Vec3(0.6, -0.2, 0.0), Vec3(0.0, 0.5, 0.0)}) scene.add(corner);
  scene.system.faces = std::vector<Face>{{{PointId{0}, PointId{1}, PointId{2}}}};
  const auto count_shades = [&](int samples) {
    const ViewOptions options{.points = false, .grid = false, .samples = samples};
    const Image image = draw(scene, {}, camera_on(scene, 1.6), options, 160, 100);
    return std::set<std::uint8_t>(image.pixels.begin(), image.pixels.end()).size();
  };
  EXPECT_LE(count_shades(0), 6u);   // the background and one face
  EXPECT_GE(count_shades(4), 12u);  // and intermediate colors
}

TEST(Picture, OmitsWhatIsSwitchedOff) {
  const TestSim scene = spatial_scene();
  const ViewOptions nothing{.points = false, .springs = false, .surface = false, .colliders = false, .grid = false};
  const Image image = draw(scene, {}, camera_on(scene, 1.6), nothing, 160, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 160; ++x) ASSERT_EQ(at(image, x, y), background);
}

TEST(Picture, IsDrawnIntoItsRectangleOfTheFramebuffer) {
  const TestSim scene = two_points();
  const Camera camera = camera_on(scene, 1.6);
  ViewOptions options{.grid = false};
  const Image alone = draw(scene, {}, camera, options, 160, 100);
  options.place = {30, 40, 160, 100};
  const Image within = draw(scene, {}, camera, options, 300, 200);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 160; ++x) ASSERT_EQ(at(within, x + 30, y + 40), at(alone, x, y));
}

TEST(Picture, HasThePanelsOnTop) {
  const Offscreen offscreen;
  View view;
  ImGui::CreateContext();
  ImGui::GetIO().DisplaySize = {64, 32};
  ImGui::GetIO().IniFilename = nullptr;
  view.upload_fonts();
  ImGui::NewFrame();
  ImGui::GetForegroundDrawList()->AddRectFilled({10, 4}, {30, 20}, IM_COL32(255, 0, 0, 255));
  ImGui::Render();
  const TestSim empty;
  view.draw(snapshot_of(empty), {}, camera_on(empty, 2.0), {.grid = false}, 64, 32, ImGui::GetDrawData());
  const Image image = view.read();
  ImGui::DestroyContext();
  EXPECT_EQ(at(image, 12, 6), (Color{255, 0, 0}));
  EXPECT_EQ(at(image, 28, 18), (Color{255, 0, 0}));
  EXPECT_EQ(at(image, 32, 22), background);
  EXPECT_EQ(at(image, 12, 25), background);
}

TEST(Picture, CanBeWrittenAsPngAndReadBack) {
  const TestSim scene = flat_scene();
  const Image image = draw(scene, {}, camera_on(scene, 1.6), {}, 160, 100);
  write_png(image, "written.png");
  const Image again = read_png("written.png");
  EXPECT_EQ(again.width, image.width);
  EXPECT_EQ(again.pixels, image.pixels);
  std::filesystem::remove("written.png");
}

TEST(Picture, ReportsWhyItCannotBeWritten) {
  const Image image{1, 1, {1, 2, 3}};
  try {
    write_png(image, "/nowhere/at/all.png");
    FAIL() << "written";
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/at/all.png: cannot be written: No such file or directory");
  }
  EXPECT_THROW(write_png(Image{2, 2, std::vector<std::uint8_t>(12)}, "/dev/full"), FileError);
}

TEST(StrainScale, IsRoundedUpToOneTwoOrFive) {
  const auto scale = [](double min, double max) { return View::strain_scale({.min_strain = min, .max_strain = max}); };
  EXPECT_DOUBLE_EQ(scale(0.0, 0.011), 0.02);
  EXPECT_DOUBLE_EQ(scale(-0.3, 0.1), 0.5);
  EXPECT_DOUBLE_EQ(scale(-0.1, 0.7), 1.0);
  EXPECT_DOUBLE_EQ(scale(0.0, 37.0), 50.0);
}

TEST(StrainScale, IgnoresRoundOff) {
  EXPECT_DOUBLE_EQ(View::strain_scale({.min_strain = -1e-15, .max_strain = 1e-16}), 1e-4);
  EXPECT_DOUBLE_EQ(View::strain_scale({}), 1e-4);
}

TEST(StrainScale, OfNonFiniteStrainIsOne) {
  EXPECT_DOUBLE_EQ(View::strain_scale({.max_strain = std::numeric_limits<double>::infinity()}), 1.0);
  EXPECT_DOUBLE_EQ(View::strain_scale({.min_strain = not_a_number}), 1.0);
}

TEST(StrainColor, GoesFromBlueThroughGrayToOrange) {
  const Color pressed = View::strain_color(-1.0), rest = View::strain_color(0.0), pulled = View::strain_color(1.0);
  EXPECT_GT(pressed.blue, pressed.red + 100);
  EXPECT_GT(pulled.red, pulled.blue + 100);
  EXPECT_LT(std::abs(rest.red - rest.blue), 25);
  EXPECT_LT(brightness(rest), brightness(pressed));
  EXPECT_EQ(View::strain_color(-7.0), pressed);
  EXPECT_EQ(View::strain_color(7.0), pulled);
  EXPECT_EQ(View::strain_color(not_a_number), rest);
}

TEST(StrainColor, ChangesContinuously) {
  for (int i = -100; i < 100; ++i) {
    const Color here = View::strain_color(i / 100.0), next = View::strain_color((i + 1) / 100.0);
    EXPECT_GE(next.red, here.red - 1);
    EXPECT_LE(next.blue, here.blue + 1);
  }
}

}  // namespace
}  // namespace hooke
