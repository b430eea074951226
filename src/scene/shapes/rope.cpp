#include "scene/shapes/rope.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/file_limits.h"
#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"

namespace hooke {
namespace {

constexpr ShapeVector vectors[] = {{"from"}, {"to"}};

constexpr auto numbers = [] {
  std::array<ShapeNumber, fabric_numbers + 2> all{};
  const auto rest = std::ranges::copy(make_fabric_numbers(MassModel::Equal), all.begin()).out;
  rest[0] = {
      .name = "points", .min = 2, .max = 500, .default_value = not_given, .integer = true, .is_required = true, .max_integer = max_points};
  rest[1] = cable_number;
  return all;
}();

Rope rope_of(const Shape& shape) {
  return {.from = shape.vectors[0],
          .to = shape.vectors[1],
          .points = shape.count("points"),
          .fabric = fabric_of(shape),
          .is_cable = shape["cable"] != 0.0};
}

std::optional<ShapeError> check(const Shape& shape) {
  if (auto error = check_fabric(shape)) return error;
  if (!(glm::length(shape.vectors[1] - shape.vectors[0]) > 0.0)) return ShapeError{{}, "must have different positions for from and to"};
  return std::nullopt;
}

constexpr NailKeyword nail_keywords[] = {
    {"from", [](const Shape&) { return std::vector<Index>{0}; }},
    {"to", [](const Shape& shape) { return std::vector<Index>{static_cast<Index>(shape.count("points") - 1)}; }},
};

ElementCount element_count(const Shape& shape) { return element_count_of(rope_of(shape)); }
void make(const Shape& shape, Network& network) { generate(rope_of(shape), network); }

}  // namespace

ElementCount element_count_of(const Rope& rope) {
  const auto points = static_cast<std::uint64_t>(std::max<std::int64_t>(rope.points, 1));
  return {.points = points, .springs = points - 1};
}

void generate(const Rope& rope, Network& network) {
  ShapeBuilder builder(network);
  const std::size_t first = builder.first();
  const Fabric& fabric = rope.fabric;
  const bool tributary = fabric.mass_model == MassModel::Tributary;
  const double length = glm::length(rope.to - rope.from), segments = static_cast<double>(rope.points - 1);
  const double total = fabric.mass ? *fabric.mass : *fabric.density * length;

  for (std::int64_t i = 0; i < rope.points; ++i) {
    const bool is_end = i == 0 || i == rope.points - 1;
    const double mass = tributary ? total / segments * (is_end ? 0.5 : 1.0) : total / static_cast<double>(rope.points);
    builder.add_point(rope.from + static_cast<double>(i) / segments * (rope.to - rope.from), mass,
                      fabric.point_radius.value_or(0.25 * length / segments));
  }
  for (const Index i : fabric.nails) network.points[first + static_cast<std::size_t>(i)].nailed = true;

  // n springs in series are as stiff as the whole rope if each is n times as stiff; dashpots likewise
  const double weight = tributary ? segments : 1.0;
  for (std::size_t i = first; i + 1 < network.points.size(); ++i) {
    const double segment_length = glm::length(network.position[i + 1] - network.position[i]);
    const double stiffness = fabric.stiffness_per_strain ? *fabric.stiffness_per_strain / segment_length : weight * fabric.stiffness;
    const double damping = fabric.damping_per_length ? *fabric.damping_per_length * segment_length : weight * fabric.damping;
    builder.add_spring(i, i + 1, stiffness, damping, SpringFamily::None, rope.is_cable);
  }
}

constinit const ShapeKind rope_shape{.id = "rope",
                                     .description = "A row of points between two given ends.",
                                     .numbers = numbers,
                                     .vectors = vectors,
                                     .nail_keywords = nail_keywords,
                                     .check = check,
                                     .element_count = element_count,
                                     .make = make};

}  // namespace hooke
