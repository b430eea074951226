// A chain of stiff links.
#include "scene/shapes/builder.h"
#include "scene/shapes/hanging_line.h"
#include "scene/shapes/rows.h"

namespace hooke {
namespace {

constexpr ShapeNumber numbers[] = {
    {"length", "Length", "m", 0.05, 20.0, 1.2},
    {"span", "End distance", "m", 0.01, 20.0, 0.9},
    {"links", "Links", "", 1, 200, 12, true},
    {"mass", "Mass", "kg", 0.001, 100.0, 0.4},
    {"stiffness", "Link stiffness", "N/m", 1.0, 1e6, 1500.0},
    {"damping", "Dashpots", "N s/m", 0.0, 100.0, 0.5},
};

ElementCount element_count(const Shape& shape) {
  const auto links = static_cast<std::uint64_t>(shape.count("links"));
  return {.points = 3 * links + 1, .springs = 6 * links};
}

// A link is a stiff rhombus between two joints, every corner connected to every other:
//        b
//     a     d     a, d: joints, shared with the next links
//        c
void make(const Shape& shape, Network& network) {
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

constinit const ShapeKind chain_shape{.id = "chain",
                                      .label = "Chain of links",
                                      .description = "Stiff rhombi in a row, joined at their tips.",
                                      .details = "`stiffness` and `damping` are those of each spring of a link",
                                      .numbers = numbers,
                                      .supports = line_supports,
                                      .contact = ShapeContact::Springs,
                                      .element_count = element_count,
                                      .make = make};

}  // namespace hooke
