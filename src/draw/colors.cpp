#include "draw/colors.h"

#include <algorithm>
#include <array>

#include "draw/view.h"

namespace hooke {
namespace {

// The same on every background: the drawn square has a dark edge.
constexpr Color nail{247, 201, 72};

constexpr Palette on_dark{.point = {205, 214, 222},
                          .nailed = nail,
                          .selected = {255, 82, 82},
                          .spring = {139, 155, 170},
                          .face = {88, 82, 104},
                          .collider = {86, 97, 110},
                          .line = {120, 133, 146},
                          .hover = {255, 255, 255},
                          .failed = {255, 0, 170},
                          .crossed = {64, 240, 200},
                          .velocity = {120, 220, 130},
                          .force = {240, 130, 220},
                          .shadow = {8, 10, 13, 140}};

constexpr Palette on_light{.point = {70, 82, 94},
                           .nailed = nail,
                           .selected = {214, 30, 40},
                           .spring = {112, 124, 136},
                           .face = {196, 190, 208},
                           .collider = {176, 186, 196},
                           .line = {128, 138, 148},
                           .hover = {20, 24, 28},
                           .failed = {200, 0, 130},
                           .crossed = {0, 128, 108},
                           .velocity = {20, 120, 40},
                           .force = {170, 20, 140},
                           .shadow = {52, 58, 70, 105}};

// Blue through gray to orange: distinguishable with every common color vision deficiency; lightness changes outwards from the middle.
constexpr std::array<Color, 5> strain_stops{{{64, 156, 255}, {108, 156, 206}, {134, 142, 150}, {214, 152, 92}, {255, 140, 26}}};

}  // namespace

Palette palette_for(const Color& background) {
  const double luminance = 0.2126 * background.red + 0.7152 * background.green + 0.0722 * background.blue;
  return luminance < 140.0 ? on_dark : on_light;
}

Color mix(const Color& a, const Color& b, double t) {
  const auto channel = [t](std::uint8_t from, std::uint8_t to) { return static_cast<std::uint8_t>(std::lround(from + t * (to - from))); };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

double View::strain_scale(const Snapshot& snapshot) {
  constexpr double min = 1e-4;  // below this, colors would show rounding errors
  const double max = std::max(std::abs(snapshot.min_strain), std::abs(snapshot.max_strain));
  if (!std::isfinite(max)) return 1.0;
  if (max <= min) return min;
  const double decade = std::pow(10.0, std::floor(std::log10(max)));
  for (const double step : {1.0, 2.0, 5.0})
    if (max <= step * decade) return step * decade;
  return 10.0 * decade;
}

Color View::strain_color(double relative) {
  // Steeper around zero, so that small strains stay visible next to a large one.
  const double strength = std::isnan(relative) ? 0.0 : std::pow(std::min(std::abs(relative), 1.0), 0.6);
  const double last = strain_stops.size() - 1;
  const double place = 0.5 * (std::copysign(strength, relative) + 1.0) * last;
  const auto below = static_cast<std::size_t>(std::min(place, last - 1.0));
  return mix(strain_stops[below], strain_stops[below + 1], place - static_cast<double>(below));
}

}  // namespace hooke
