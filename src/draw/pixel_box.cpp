#include "draw/pixel_box.h"

#include <algorithm>
#include <cmath>

namespace hooke {

std::array<PixelBox, 4> around(const PixelBox& inner, const PixelBox& whole) {
  if (inner.is_empty()) return {whole};
  return {{{whole.left, whole.bottom, whole.right, inner.bottom},
           {whole.left, inner.top, whole.right, whole.top},
           {whole.left, inner.bottom, inner.left, inner.top},
           {inner.right, inner.bottom, whole.right, inner.top}}};
}

void PixelExtent::add(const ProjectedPoint& corner) {
  if (corner.outside & (Before | NotFinite)) {
    left_ = bottom_ = -infinity;
    right_ = top_ = infinity;
    return;
  }
  left_ = std::min(left_, corner.x);
  right_ = std::max(right_, corner.x);
  bottom_ = std::min(bottom_, corner.y);
  top_ = std::max(top_, corner.y);
}

PixelBox PixelExtent::within(const PixelBox& picture) const {
  // positions are relative to the corner of the picture, and drivers round them to fractions of a pixel
  const auto clamped = [](float place, int size) { return static_cast<int>(std::clamp(place, 0.0f, static_cast<float>(size))); };
  const int width = picture.right - picture.left, height = picture.top - picture.bottom;
  return {picture.left + clamped(std::floor(left_) - 1.0f, width), picture.bottom + clamped(std::floor(bottom_) - 1.0f, height),
          picture.left + clamped(std::ceil(right_) + 1.0f, width), picture.bottom + clamped(std::ceil(top_) + 1.0f, height)};
}

}  // namespace hooke
