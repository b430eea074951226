// Colors for drawing, and the palette of Hooke.
#pragma once

#include <cmath>
#include <cstdint>

#include "sim/model/system.h"

namespace hooke {

// sRGB with opacity, as stored in vertices.
struct Rgba {
  std::uint8_t red = 0, green = 0, blue = 0, opacity = 255;
};

inline Rgba rgba(const Color& color, double opacity = 1.0) {
  return {color.red, color.green, color.blue, static_cast<std::uint8_t>(std::lround(255.0 * opacity))};
}

// Colors with enough contrast on a dark or light background.
struct Palette {
  Color point, nailed, selected, spring, face, collider, line, hover, failed, crossed, velocity, force;
  Rgba shadow;  // full shadow
};
Palette palette_for(const Color& background);

// From a (t = 0) to b (t = 1).
Color mix(const Color& a, const Color& b, double t);

}  // namespace hooke
