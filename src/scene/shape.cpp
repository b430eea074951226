#include "scene/shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scene/shapes/rows.h"

namespace hooke {
namespace {

constexpr double radians_per_degree = 3.14159265358979323846 / 180.0;  // [rad]

// x to the right, y up, z towards the viewer: about x by the tilt, then about y by the turn.
Vec3 rotated(const Shape& shape, const Vec3& v) {
  if (shape.turn == 0.0 && shape.tilt == 0.0) return v;
  const double ct = std::cos(shape.tilt * radians_per_degree), st = std::sin(shape.tilt * radians_per_degree);
  const double cu = std::cos(shape.turn * radians_per_degree), su = std::sin(shape.turn * radians_per_degree);
  const Vec3 tilted(v.x, ct * v.y - st * v.z, st * v.y + ct * v.z);
  return {cu * tilted.x + su * tilted.z, tilted.y, cu * tilted.z - su * tilted.x};
}

}  // namespace

Table<ShapeKind> shape_kinds() {
#define ROW(name) &name##_shape,
  static constexpr const ShapeKind* rows[] = {
#include "scene/shapes/list.inc"
  };
#undef ROW
  return Table<ShapeKind>(rows);
}

Table<ShapeKind> placeable_shapes() {
  static const std::vector<const ShapeKind*> rows = [] {
    std::vector<const ShapeKind*> placeable;
    for (const ShapeKind& kind : shape_kinds())
      if (kind.is_placeable()) placeable.push_back(&kind);
    return placeable;
  }();
  return Table<ShapeKind>(rows);
}

const ShapeKind* find_shape_kind(std::string_view id) {
  for (const ShapeKind& kind : shape_kinds())
    if (kind.id == id) return &kind;
  return nullptr;
}

double Shape::operator[](std::string_view name) const {
  const auto row = std::ranges::find(kind->numbers, name, &ShapeNumber::name);
  assert(row != kind->numbers.end());
  return values[static_cast<std::size_t>(row - kind->numbers.begin())];
}

bool Shape::has(std::string_view name) const { return !std::isnan((*this)[name]); }

Shape default_shape(const ShapeKind& kind) {
  Shape shape{.kind = &kind};
  for (std::size_t i = 0; i < kind.numbers.size(); ++i) shape.values[i] = kind.numbers[i].default_value;
  return shape;
}

ElementCount element_count_of(const Shape& shape) { return shape.kind->element_count(shape); }

void generate(const Shape& shape, Network& network) {
  const std::size_t first = network.points.size();
  shape.kind->make(shape, network);
  for (std::size_t i = first; i < network.points.size(); ++i) {
    if (shape.kind->vectors.empty()) network.position[i] = shape.at + rotated(shape, network.position[i]);
    // nailed points show it when they are released
    if (shape.color) network.points[i].color = shape.color;
  }
}

}  // namespace hooke
