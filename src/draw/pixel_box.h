// Rectangles of pixels that shapes cover.
#pragma once

#include <array>
#include <limits>

#include "draw/projection.h"

namespace hooke {

// Pixels from the lower left corner of the picture; `right` and `top` are excluded.
struct PixelBox {
  int left = 0, bottom = 0, right = 0, top = 0;
  bool is_empty() const { return left >= right || bottom >= top; }
};

// The pixels of `whole` outside `inner`, which lies in it: below, above, left and right of it.
std::array<PixelBox, 4> around(const PixelBox& inner, const PixelBox& whole);

// The extent of polygons in the picture.
class PixelExtent {
 public:
  // A corner of a polygon. One before the near clip plane extends to the whole picture.
  void add(const ProjectedPoint& corner);
  // All pixels that the polygons can touch, with their neighbors; nothing without polygons.
  PixelBox within(const PixelBox& picture) const;

 private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  float left_ = infinity, bottom_ = infinity, right_ = -infinity, top_ = -infinity;
};

}  // namespace hooke
