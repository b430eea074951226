// A flag on a pole.
#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"
#include "scene/shapes/upright_cloth.h"

namespace hooke {
namespace {

constexpr std::string_view supports[] = {"pole"};

constexpr ShapeNumber numbers[] = {
    {"width", "Width", "m", 0.05, 20.0, 1.2},
    {"height", "Height", "m", 0.05, 20.0, 0.8},
    {"columns", "Columns", "", 2, 200, 30, true},
    {"rows", "Rows", "", 2, 200, 20, true},
    {"pole", "Pole", "m", 0.1, 40.0, 2.0},
    {"density", "Density", "kg/m^2", 0.01, 10.0, 0.12},
    {"stiffness", "Stiffness", "N/m", 0.1, 1e5, 60.0},
    {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.01},
};

ElementCount element_count(const Shape& shape) {
  ElementCount count = element_count_of(sheet_cloth(shape));
  count.points += 2;
  count.springs += 1;
  return count;
}

// The pole ends slightly above the cloth that is attached to it.
void make(const Shape& shape, Network& network) {
  add_nailed_cloth(shape, sheet_cloth(shape), network);
  ShapeBuilder builder(network);
  const double pole_x = -0.5 * shape["width"] - 0.01, top = 0.5 * shape["height"] + 0.04;
  const std::size_t head = builder.add_point({pole_x, top, 0.0}, 1.0, 0.02, true);
  const std::size_t foot = builder.add_point({pole_x, top - shape["pole"], 0.0}, 1.0, 0.02, true);
  builder.add_spring(head, foot, shape["stiffness"], shape["damping"]);
}

}  // namespace

constinit const ShapeKind flag_shape{.id = "flag",
                                     .label = "Flag on a pole",
                                     .description = "A sheet nailed to a pole along its left edge; it needs wind.",
                                     .numbers = numbers,
                                     .supports = supports,
                                     .contact = ShapeContact::Faces,
                                     .element_count = element_count,
                                     .make = make};

}  // namespace hooke
