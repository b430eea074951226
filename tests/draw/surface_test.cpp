// Pictures of the surface of a cloth: lit from both sides, textured, colored by strain.
#include <gtest/gtest.h>

#include <set>

#include "support/picture.h"

namespace hooke {
namespace {

// A square of 1 m in the plane z = 0, 3 x 3 points, textured once with a picture of 2 x 2 pixels.
struct Sheet {
  TestSim sim;
  ViewOptions options{.points = false, .springs = false, .colliders = false, .grid = false, .strain_colors = false, .samples = 0};
  ClothCoordinates cloth_coordinates;

  Sheet() {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) {
        sim.add({0.5 * column - 0.5, 0.5 - 0.5 * row, 0.0});
        cloth_coordinates.emplace_back(0.5 * column, 0.5 * row);
      }
    for (std::uint32_t row = 0; row < 2; ++row)
      for (std::uint32_t column = 0; column < 2; ++column) {
        const std::uint32_t at = 3 * row + column;
        sim.system.faces.push_back({{PointId{at}, PointId{at + 3}, PointId{at + 1}}});
        sim.system.faces.push_back({{PointId{at + 1}, PointId{at + 3}, PointId{at + 4}}});
      }
  }
  void cloth_texture(std::vector<std::uint8_t> pixels, double width = 1.0) {
    options.cloth_texture = {std::make_shared<const Picture>(Picture{2, 2, std::move(pixels)}),
                             std::make_shared<const ClothCoordinates>(cloth_coordinates), width};
  }
  Camera camera(bool from_behind = false) const {
    Camera camera;
    camera.distance = 2.0;
    if (from_behind) camera.back = {0.0, 0.0, -1.0};
    return camera;
  }
  Image draw(bool from_behind = false) const { return hooke::draw(sim, {}, camera(from_behind), options, 300, 300); }
};

const std::vector<std::uint8_t> four_colors{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

TEST(Surface, ShowsTheTextureUprightOnce) {
  Sheet sheet;
  sheet.cloth_texture(four_colors);
  const Image image = sheet.draw();
  const auto seen = [&](double x, double y) { return at(image, sheet.camera(), {x, y, 0.0}); };
  const Color red = seen(-0.25, 0.25), green = seen(0.25, 0.25), blue = seen(-0.25, -0.25), white = seen(0.25, -0.25);
  EXPECT_GT(red.red, 3 * std::max(red.green, red.blue));
  EXPECT_GT(green.green, 3 * std::max(green.red, green.blue));
  EXPECT_GT(blue.blue, 3 * std::max(blue.red, blue.green));
  EXPECT_EQ(white.red, white.blue);
  EXPECT_GT(white.red, 180);
}

TEST(Surface, RepeatsTheTextureByItsWidth) {
  Sheet sheet;
  sheet.cloth_texture(four_colors, 0.5);
  const Image image = sheet.draw();
  for (const Vec3& place : {Vec3(-0.375, 0.375, 0.0), Vec3(0.125, 0.375, 0.0), Vec3(0.125, -0.125, 0.0)}) {
    const Color red = at(image, sheet.camera(), place);
    EXPECT_GT(red.red, 3 * std::max(red.green, red.blue));
  }
}

TEST(Surface, IsTintedByTheColorOfItsPoints) {
  Sheet sheet;
  sheet.cloth_texture({255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255});
  for (Index i = 0; i < 9; ++i) sheet.sim.system.point(i).color = Color{255, 0, 0};
  const Color seen = at(sheet.draw(), sheet.camera(), Vec3(0.1, 0.1, 0.0));
  EXPECT_GT(seen.red, 180);
  EXPECT_LT(std::max(seen.green, seen.blue), 40);
}

TEST(Surface, IsLitFromBothSidesAndDarkerOnTheBack) {
  const Sheet sheet;
  const Color front = at(sheet.draw(), sheet.camera(), Vec3(0.1, 0.1, 0.0));
  const Color back = at(sheet.draw(true), sheet.camera(true), Vec3(0.1, 0.1, 0.0));
  EXPECT_GT(brightness(front), brightness(back) + 40);
  EXPECT_GT(brightness(back), 200);

  // a light from behind makes the back brighter: neither side is preferred
  Sheet leaning;
  for (Vec3& place : leaning.sim.state.position) place.z = 0.6 * place.y;
  const Color lower = at(leaning.draw(), leaning.camera(), Vec3(0.0));
  const Color upper = at(leaning.draw(true), leaning.camera(true), Vec3(0.0));
  EXPECT_GT(brightness(upper), brightness(lower));
}

// A roof of two slopes: with smooth normals the brightness changes gradually across the ridge.
TEST(Surface, HasSmoothNormals) {
  Sheet roof;
  for (Vec3& place : roof.sim.state.position) place.z = -0.5 * std::abs(place.x);
  const Image image = roof.draw();
  const Vec3 ridge = roof.camera().project(Vec3(0.0, 0.1, 0.0), {300, 300});
  int largest = 0;
  for (int x = static_cast<int>(ridge.x) - 40; x < static_cast<int>(ridge.x) + 40; ++x) {
    const int y = static_cast<int>(ridge.y);
    largest = std::max(largest, std::abs(brightness(at(image, x + 1, y)) - brightness(at(image, x, y))));
  }
  EXPECT_LE(largest, 9);
  EXPECT_GT(brightness(at(image, roof.camera(), {-0.4, 0.1, -0.2})), brightness(at(image, roof.camera(), {0.4, 0.1, -0.2})) + 60);
}

TEST(Surface, ShowsStrainWhereSpringsAreHidden) {
  Sheet sheet;
  sheet.cloth_texture(four_colors);
  for (std::uint32_t i = 0; i < 8; ++i) sheet.sim.join(PointId{i}, PointId{i + 1}, 1.0, 1e-2);
  sheet.options.strain_colors = true;
  const Color stretched = at(sheet.draw(), sheet.camera(), Vec3(0.1, 0.1, 0.0));
  EXPECT_GT(stretched.red, stretched.blue + 60);
  EXPECT_GT(stretched.green, stretched.blue + 20);

  // where springs are shown, they show the strain and the texture stays
  sheet.options.springs = true;
  const Color blue = at(sheet.draw(), sheet.camera(), Vec3(-0.25, -0.2, 0.0));
  EXPECT_GT(blue.blue, 3 * std::max(blue.red, blue.green));
}

TEST(Surface, ShowsItsNailsWhenDrawnAlone) {
  Sheet sheet;
  sheet.sim.system.point(4).nailed = true;
  const Color nail = at(sheet.draw(), sheet.camera(), Vec3(0.0));
  EXPECT_GT(nail.red, nail.blue + 100);
  EXPECT_GT(nail.green, nail.blue + 80);
}

TEST(Surface, IsAbsentWhenSwitchedOff) {
  Sheet sheet;
  sheet.options.surface = false;
  const Image image = sheet.draw();
  EXPECT_EQ(std::set<std::uint8_t>(image.pixels.begin(), image.pixels.end()), (std::set<std::uint8_t>{32, 36, 40}));
}

TEST(Surface, CanChangeAndRemoveItsTexture) {
  Sheet sheet;
  const Offscreen offscreen;
  View view;
  const auto seen = [&] {
    view.draw(snapshot_of(sheet.sim), {}, sheet.camera(), sheet.options, 300, 300, nullptr);
    return at(view.read(), sheet.camera(), Vec3(-0.25, 0.25, 0.0));
  };
  const Color plain = seen();
  sheet.cloth_texture(four_colors);
  const Color red = seen();
  EXPECT_GT(red.red, 3 * red.green);
  sheet.cloth_texture({0, 255, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0});
  const Color green = seen();
  EXPECT_GT(green.green, 3 * green.red);
  sheet.options.cloth_texture = {};
  EXPECT_EQ(seen(), plain);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

}  // namespace
}  // namespace hooke
