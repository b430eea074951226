// Large sheets whose cells are smaller than pixels are drawn with some of their rows and columns.
#include <cmath>

#include "draw/parts/network_renderer.h"
#include "support/picture.h"

namespace hooke {
namespace {

constexpr int rows = 320, columns = 330;

// Two sheets side by side, the second smaller, and a weight on a spring below the first.
TestSim large_sheets() {
  TestSim sim;
  const auto add_sheet = [&](int height, int width, double left) {
    const auto first = static_cast<PointId>(sim.system.point_count());
    for (int r = 0; r < height; ++r)
      for (int c = 0; c < width; ++c) sim.add({left + 1.0 * c / columns, 0.5 - 1.0 * r / rows, 0.05 * std::sin(20.0 * c / columns)});
    const auto id = [&](int r, int c) { return static_cast<PointId>(static_cast<int>(first) + r * width + c); };
    for (int r = 0; r + 1 < height; ++r)
      for (int c = 0; c + 1 < width; ++c) {
        sim.join(id(r, c), id(r, c + 1), 10.0, 1.0 / columns);
        sim.system.faces.push_back({{id(r, c), id(r + 1, c), id(r, c + 1)}});
        sim.system.faces.push_back({{id(r, c + 1), id(r + 1, c), id(r + 1, c + 1)}});
      }
    return id(height - 1, width / 3);
  };
  const PointId low = add_sheet(rows, columns, -0.8);
  add_sheet(40, 30, 0.4);
  sim.join(low, sim.add({-0.45, -0.65, 0.0}), 10.0, 0.1);
  return sim;
}

ViewOptions surface_only() {
  ViewOptions options;
  options.springs = options.points = options.strain_colors = false;
  return options;
}

Camera camera_at(double distance) {
  Camera camera;
  camera.distance = distance;
  return camera;
}

struct Drawn {
  std::size_t points, corners;
  bool has_weight;
};
Drawn project(const TestSim& sim, const Marks& marks, const ViewOptions& options, double distance) {
  const Snapshot snapshot = snapshot_of(sim);
  const Camera camera = camera_at(distance);
  const Projection projection(camera, 300, 200);
  const Palette palette = palette_for(options.background);
  NetworkRenderer renderer;
  renderer.project({snapshot, marks, options, projection, camera, palette});
  const GLuint weight = static_cast<GLuint>(sim.system.point_count()) - 1;
  for (std::size_t n = 0; n < renderer.drawn().size(); ++n) EXPECT_EQ(renderer.number_of(renderer.drawn()[n]), n);
  for (const GLuint corner : renderer.corners()) EXPECT_EQ(renderer.drawn()[renderer.number_of(corner)], corner);
  return {renderer.drawn().size(), renderer.corners().size(), renderer.drawn().back() == weight};
}

TEST(CoarseSheet, IsDrawnWithFewerPointsWhereItsCellsAreSmall) {
  const TestSim sim = large_sheets();
  const auto all = static_cast<std::size_t>(sim.system.point_count());
  const Drawn far = project(sim, {}, surface_only(), 3.0), near = project(sim, {}, surface_only(), 0.2);
  EXPECT_LT(far.points, all / 8);
  EXPECT_LT(far.corners, 3 * sim.system.faces.size() / 8);
  EXPECT_TRUE(far.has_weight);
  EXPECT_EQ(near.points, all);
  EXPECT_EQ(near.corners, 3 * sim.system.faces.size());
  // springs and points are all of them
  ViewOptions with_points = surface_only();
  with_points.points = true;
  EXPECT_EQ(project(sim, {}, with_points, 3.0).points, all);
  Marks marks;
  marks.hovered_point = PointId{7};
  EXPECT_EQ(project(sim, marks, surface_only(), 3.0).points, far.points);
  marks.hovered_spring = SpringId{7};
  EXPECT_EQ(project(sim, marks, surface_only(), 3.0).points, all);
}

TEST(CoarseSheet, LooksLikeTheWholeSheet) {
  const TestSim sim = large_sheets();
  Marks of_nothing;
  of_nothing.hovered_spring = static_cast<SpringId>(sim.system.spring_count());  // there is none, but all points are drawn
  const Image coarse = draw(sim, {}, camera_at(3.0), surface_only(), 300, 200),
              whole = draw(sim, of_nothing, camera_at(3.0), surface_only(), 300, 200);
  double sum = 0.0;
  int different = 0;
  ASSERT_EQ(coarse.pixels.size(), whole.pixels.size());
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    const int difference = std::abs(int{coarse.pixels[i]} - int{whole.pixels[i]});
    sum += difference;
    different += difference > 40 ? 1 : 0;
  }
  EXPECT_LT(sum / static_cast<double>(whole.pixels.size()), 1.0);
  EXPECT_LT(different, static_cast<int>(whole.pixels.size()) / 200);
  // the sheet is in the picture
  const Color color = at(whole, camera_at(3.0), {-0.3, 0.1, 0.0}), beside = at(whole, 5, 5);
  EXPECT_GT(std::abs(brightness(color) - brightness(beside)), 60);
}

}  // namespace
}  // namespace hooke
