// A curtain that hangs in folds by rings.
#include <algorithm>
#include <cmath>

#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"
#include "scene/shapes/upright_cloth.h"

namespace hooke {
namespace {

constexpr std::string_view supports[] = {"rings"};

constexpr ShapeNumber numbers[] = {
    {"width", "Width of the rail", "m", 0.1, 20.0, 1.4}, {"height", "Height", "m", 0.05, 20.0, 1.2},
    {"fullness", "Fullness", "times", 1.0, 3.0, 1.5},    {"rings", "Rings", "", 2, 60, 9, true},
    {"fold", "Half-fold columns", "", 1, 10, 2, true},   {"rows", "Rows", "", 2, 200, 24, true},
    {"density", "Density", "kg/m^2", 0.01, 10.0, 0.2},   {"stiffness", "Stiffness", "N/m", 0.1, 1e5, 60.0},
    {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.01},
};

std::int64_t curtain_columns(const Shape& shape) { return 2 * shape.count("fold") * (shape.count("rings") - 1) + 1; }

Cloth curtain_cloth(const Shape& shape) {
  Cloth cloth = upright_cloth(shape, std::max(1.0, shape["fullness"]) * shape["width"], curtain_columns(shape));
  cloth.fabric.density = shape["density"];
  return cloth;
}

ElementCount element_count(const Shape& shape) {
  ElementCount count = element_count_of(curtain_cloth(shape));
  count.points += static_cast<std::uint64_t>(shape.count("rings"));
  count.springs += static_cast<std::uint64_t>(shape.count("rings"));
  return count;
}

// The flat cloth is folded along its columns without strain, to alternate sides between rings:
//   o   /\      o     seen from above
//    \/    \  /
void make(const Shape& shape, Network& network) {
  ShapeBuilder builder(network);
  add_nailed_cloth(shape, curtain_cloth(shape), network);
  const std::int64_t columns = curtain_columns(shape), fold = shape.count("fold");
  const double fullness = std::max(1.0, shape["fullness"]), pitch = shape["width"] * fullness / static_cast<double>(columns - 1);
  const double depth = pitch * std::sqrt(1.0 - 1.0 / (fullness * fullness));
  for (std::int64_t column = 0; column < columns; ++column) {
    const std::int64_t column_in_gap = column % (2 * fold), side = (column / (2 * fold)) % 2 == 0 ? 1 : -1;
    const double x = shape["width"] * (static_cast<double>(column) / static_cast<double>(columns - 1) - 0.5);
    const double z = static_cast<double>(side * std::min(column_in_gap, 2 * fold - column_in_gap)) * depth;
    for (std::int64_t row = 0; row < shape.count("rows"); ++row) {
      Vec3& place = network.position[builder.first() + static_cast<std::size_t>(row * columns + column)];
      place = {x, place.y, z};
    }
  }

  // rings: nails on the rail, slightly above the cloth
  const double above = 0.04 * shape["height"], radius = 0.25 * above;
  for (std::int64_t ring = 0; ring < shape.count("rings"); ++ring) {
    const std::size_t top = builder.first() + static_cast<std::size_t>(2 * fold * ring);
    const std::size_t nail = builder.add_point(network.position[top] + Vec3(0.0, above, 0.0), network.points[top].mass, radius, true);
    builder.add_spring(nail, top, 2.0 * shape["stiffness"], shape["damping"]);
  }
}

}  // namespace

constinit const ShapeKind curtain_shape{
    .id = "curtain",
    .label = "Curtain with rings",
    .description = "A folded sheet that hangs from a rail by rings.",
    .details =
        "`width` is that of the rail; the cloth is `fullness` times as wide, with `fold` columns per half fold, and starts unstrained",
    .numbers = numbers,
    .supports = supports,
    .is_3d_only = true,
    .contact = ShapeContact::Faces,
    .element_count = element_count,
    .make = make};

}  // namespace hooke
