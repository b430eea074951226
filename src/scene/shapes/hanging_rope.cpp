// A rope that hangs from one end or both.
#include "scene/shapes/builder.h"
#include "scene/shapes/hanging_line.h"
#include "scene/shapes/rope.h"
#include "scene/shapes/rows.h"

namespace hooke {
namespace {

constexpr ShapeNumber numbers[] = {
    {"length", "Length", "m", 0.05, 20.0, 1.2},
    {"span", "End distance", "m", 0.01, 20.0, 0.9},
    {"points", "Points", "", 2, 500, 32, true},
    {"mass", "Mass", "kg", 0.001, 100.0, 0.15},
    {"stiffness", "Stiffness", "N/m", 0.1, 1e5, 60.0},
    {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.01},
    cable_number,
};

ElementCount element_count(const Shape& shape) {
  const auto points = static_cast<std::uint64_t>(shape.count("points"));
  return {.points = points, .springs = points - 1};
}

// As a material: n springs in series, each n times as stiff as the whole; the two ends have half the mass of an inner point.
void make(const Shape& shape, Network& network) {
  ShapeBuilder builder(network);
  const std::int64_t segments = shape.count("points") - 1;
  const double n = static_cast<double>(segments);
  for (std::int64_t i = 0; i <= segments; ++i) {
    const bool is_first = i == 0, is_last = i == segments;
    builder.add_point(place_on_line(shape, static_cast<double>(i) / n), shape["mass"] / n * (is_first || is_last ? 0.5 : 1.0),
                      0.25 * shape["length"] / n, is_end_nailed(shape, is_first, is_last));
    if (i > 0)
      builder.add_spring(builder.first() + static_cast<std::size_t>(i) - 1, builder.first() + static_cast<std::size_t>(i),
                         n * shape["stiffness"], n * shape["damping"], SpringFamily::None, shape["cable"] != 0.0);
  }
}

}  // namespace

constinit const ShapeKind hanging_rope_shape{
    .id = "hanging_rope",
    .label = "Rope",
    .description = "A rope that hangs from one end or both; its properties do not depend on the number of points.",
    .details = "`stiffness` and `damping` are those of the whole rope. Nailed at both ends, it starts as a V if it is longer than `span`",
    .numbers = numbers,
    .supports = line_supports,
    .contact = ShapeContact::Springs,
    .element_count = element_count,
    .make = make};

}  // namespace hooke
