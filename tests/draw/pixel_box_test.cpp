#include "draw/pixel_box.h"

#include <gtest/gtest.h>

#include <vector>

namespace hooke {
namespace {

std::size_t place(int x, int y) { return 50 * static_cast<std::size_t>(y) + static_cast<std::size_t>(x); }

bool is_same(const PixelBox& a, const PixelBox& b) {
  return a.left == b.left && a.bottom == b.bottom && a.right == b.right && a.top == b.top;
}

TEST(PixelBoxes, AroundABoxCoverEveryOtherPixelOnce) {
  const PixelBox whole{3, 5, 40, 31};
  for (const PixelBox& inner :
       {PixelBox{10, 9, 20, 12}, PixelBox{3, 5, 40, 31}, PixelBox{3, 5, 4, 6}, PixelBox{39, 5, 40, 31}, PixelBox{}}) {
    std::vector<int> count(50 * 50, 0);
    const auto paint = [&](const PixelBox& box) {
      for (int y = box.bottom; y < box.top; ++y)
        for (int x = box.left; x < box.right; ++x) ++count[place(x, y)];
    };
    paint(inner);
    for (const PixelBox& part : around(inner, whole)) paint(part);
    for (int y = 0; y < 50; ++y)
      for (int x = 0; x < 50; ++x) {
        const bool is_inside = x >= whole.left && x < whole.right && y >= whole.bottom && y < whole.top;
        EXPECT_EQ(count[place(x, y)], is_inside ? 1 : 0) << x << " " << y;
      }
  }
}

TEST(PixelExtents, ContainTheCornersAndTheirNeighborsWithinThePicture) {
  const PixelBox picture{100, 50, 300, 150};
  PixelExtent extent;
  EXPECT_TRUE(extent.within(picture).is_empty());
  extent.add({.x = 20.5f, .y = 30.0f});
  extent.add({.x = 60.25f, .y = 90.75f});
  EXPECT_TRUE(is_same(extent.within(picture), {119, 79, 162, 142}));
  // beside the picture, and far beyond the range of integers
  extent.add({.x = -1e20f, .y = 1e20f});
  EXPECT_TRUE(is_same(extent.within(picture), {100, 79, 162, 150}));
}

TEST(PixelExtents, OfACornerBehindTheViewerAreTheWholePicture) {
  const PixelBox picture{0, 0, 64, 32};
  for (const std::uint8_t outside : {Before, NotFinite}) {
    PixelExtent extent;
    extent.add({.x = 3.0f, .y = 4.0f, .outside = outside});
    EXPECT_TRUE(is_same(extent.within(picture), picture));
  }
}

}  // namespace
}  // namespace hooke
