// Ropes and chains of links: along a line, or down to the middle and up again where their ends are nearer than they are long.
#include <algorithm>
#include <cmath>

#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"

namespace hooke {
namespace {

constexpr std::string_view line_supports[] = {"one_end", "both_ends", "nothing"};

// Where the line is at the share u of its length.
Vec3 place_on_line(const Shape& shape, double u) {
  const double length = shape["length"], span = shape.support_name() == "both_ends" ? std::min(shape["span"], length) : length;
  const double depth = 0.5 * std::sqrt(std::max(0.0, length * length - span * span));
  return {(u - 0.5) * span, 0.5 * depth - depth * (1.0 - std::abs(2.0 * u - 1.0)), 0.0};
}

bool is_end_nailed(const Shape& shape, bool is_first, bool is_last) {
  return (is_first && shape.support_name() != "nothing") || (is_last && shape.support_name() == "both_ends");
}

// ---- rope

constexpr ShapeNumber rope_numbers[] = {
    {"length", "Length", "m", 0.05, 20.0, 1.2},        {"span", "Between the ends", "m", 0.01, 20.0, 0.9},
    {"points", "Points", "", 2, 500, 32, true},        {"mass", "Mass", "kg", 0.001, 100.0, 0.15},
    {"stiffness", "Stiffness", "N/m", 0.1, 1e5, 60.0}, {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.01},
};

ElementCount rope_extent(const Shape& shape) {
  const auto points = static_cast<std::uint64_t>(shape.count("points"));
  return {.points = points, .springs = points - 1};
}

// As a material: n springs in a row, each n times as stiff as the whole; its ends have half a share of the mass.
void make_rope(const Shape& shape, Network& network) {
  ShapeBuilder builder(network);
  const std::int64_t segments = shape.count("points") - 1;
  const double n = static_cast<double>(segments);
  for (std::int64_t i = 0; i <= segments; ++i) {
    const bool is_first = i == 0, is_last = i == segments;
    builder.add_point(place_on_line(shape, static_cast<double>(i) / n), shape["mass"] / n * (is_first || is_last ? 0.5 : 1.0),
                      0.25 * shape["length"] / n, is_end_nailed(shape, is_first, is_last));
    if (i > 0)
      builder.add_spring(builder.first() + static_cast<std::size_t>(i) - 1, builder.first() + static_cast<std::size_t>(i),
                         n * shape["stiffness"], n * shape["damping"]);
  }
}

// ---- chain

constexpr ShapeNumber chain_numbers[] = {
    {"length", "Length", "m", 0.05, 20.0, 1.2},
    {"span", "Between the ends", "m", 0.01, 20.0, 0.9},
    {"links", "Links", "", 1, 200, 12, true},
    {"mass", "Mass", "kg", 0.001, 100.0, 0.4},
    {"stiffness", "Of a link's springs", "N/m", 1.0, 1e6, 1500.0},
    {"damping", "Dashpots", "N s/m", 0.0, 100.0, 0.5},
};

ElementCount chain_extent(const Shape& shape) {
  const auto links = static_cast<std::uint64_t>(shape.count("links"));
  return {.points = 3 * links + 1, .springs = 6 * links};
}

// A link is a stiff lozenge between two joints, every corner joined to every other:
//        b
//     a     d     a, d: joints, shared with the next links
//        c
void make_chain(const Shape& shape, Network& network) {
  ShapeBuilder builder(network);
  const std::int64_t links = shape.count("links");
  const double n = static_cast<double>(links), length = shape["length"] / n, half_width = 0.22 * length;
  const double mass = shape["mass"] / (3.0 * n + 1.0), k = shape["stiffness"], d = shape["damping"], radius = 0.06 * length;

  std::size_t joint = builder.add_point(place_on_line(shape, 0.0), mass, radius, is_end_nailed(shape, true, false));
  for (std::int64_t i = 0; i < links; ++i) {
    const Vec3 from = place_on_line(shape, static_cast<double>(i) / n), to = place_on_line(shape, static_cast<double>(i + 1) / n);
    const Vec3 along = (to - from) / glm::length(to - from), across(-along.y, along.x, 0.0);
    const std::size_t a = joint;
    const std::size_t b = builder.add_point(0.5 * (from + to) + half_width * across, mass, radius);
    const std::size_t c = builder.add_point(0.5 * (from + to) - half_width * across, mass, radius);
    joint = builder.add_point(to, mass, radius, is_end_nailed(shape, false, i + 1 == links));
    for (const auto& [one, other] : {std::pair{a, b}, {a, c}, {b, joint}, {c, joint}, {b, c}, {a, joint}})
      builder.add_spring(one, other, k, d);
  }
}

}  // namespace

constinit const ShapeKind hanging_rope_shape{.id = "hanging_rope",
                                             .label = "Rope",
                                             .description = "A rope by one end or both, the same stuff at every number of points.",
                                             .numbers = rope_numbers,
                                             .supports = line_supports,
                                             .is_3d_only = false,
                                             .element_count = rope_extent,
                                             .make = make_rope};
constinit const ShapeKind chain_shape{.id = "chain",
                                      .label = "Chain of links",
                                      .description = "Stiff lozenges in a row, joined at their tips.",
                                      .numbers = chain_numbers,
                                      .supports = line_supports,
                                      .is_3d_only = false,
                                      .element_count = chain_extent,
                                      .make = make_chain};

}  // namespace hooke
