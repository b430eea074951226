// The marks of selected items in pictures.
#include <gtest/gtest.h>

#include "support/picture.h"

namespace hooke {
namespace {

constexpr int picture_size = 320;  // [px], width and height of the picture

// A square net of n x n points with diagonals, which fills the picture.
TestSim square_net(int n) {
  TestSim net;
  net.system.dimensions = 2;
  const double spacing = 1.0 / (n - 1);
  std::vector<PointId> ids;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      ids.push_back(net.add({spacing * j, -spacing * i, 0.0}));
      net.system.point(net.system.index_of(ids.back())).radius = 0.25 * spacing;
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int at = i * n + j;
      if (j + 1 < n) net.join(ids[at], ids[at + 1], 100.0, spacing);
      if (i + 1 < n) net.join(ids[at], ids[at + n], 100.0, spacing);
      if (i + 1 < n && j + 1 < n) net.join(ids[at], ids[at + n + 1], 100.0, 1.414 * spacing);
    }
  return net;
}

// The fraction of the net's pixels that are strongly red.
double red_fraction(const TestSim& net, const Marks& marks) {
  const Camera camera = make_camera({}, net.system, net.state, 1.0);
  const Image image = draw(net, marks, camera, {.grid = false}, picture_size, picture_size);
  const Vec3 min = camera.project({0.0, 0.0, 0.0}, {picture_size, picture_size}),
             max = camera.project({1.0, -1.0, 0.0}, {picture_size, picture_size});
  int red = 0, all = 0;
  for (int y = static_cast<int>(min.y); y < static_cast<int>(max.y); ++y)
    for (int x = static_cast<int>(min.x); x < static_cast<int>(max.x); ++x, ++all) {
      const Color color = at(image, x, y);
      red += color.red > 100 && color.red > 2 * color.green && color.red > 2 * color.blue;
    }
  return static_cast<double>(red) / all;
}

Marks everything(const TestSim& net) {
  Marks marks;
  for (const Point& point : net.system.points()) marks.selected_points.push_back(point.id);
  for (const Spring& spring : net.system.springs()) marks.selected_springs.push_back(spring.id);
  return marks;
}

// A net of which everything is selected is still seen as a net.
TEST(Selection, OfADenseNetLeavesItsSpringsVisible) {
  for (const int n : {17, 33, 49}) {
    const TestSim net = square_net(n);
    EXPECT_EQ(red_fraction(net, {}), 0.0) << n;
    const double selected = red_fraction(net, everything(net));
    EXPECT_GT(selected, 0.1) << n;
    EXPECT_LT(selected, 0.6) << n;
  }
}

// A single point is found in any net.
TEST(Selection, OfOnePointOfADenseNetIsLargerThanThePoint) {
  const TestSim net = square_net(49);
  const double pixels = red_fraction(net, {.selected_points = {net.system.points()[24 * 49 + 24].id}}) * picture_size * picture_size;
  EXPECT_GT(pixels, 25.0);
}

}  // namespace
}  // namespace hooke
