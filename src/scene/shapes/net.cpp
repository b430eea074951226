// A net of cords.
#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"
#include "scene/shapes/upright_cloth.h"

namespace hooke {
namespace {

constexpr ShapeNumber numbers[] = {
    {"width", "Width", "m", 0.05, 20.0, 1.6},          {"height", "Height", "m", 0.05, 20.0, 0.8},
    {"columns", "Columns", "", 2, 200, 17, true},      {"rows", "Rows", "", 2, 200, 9, true},
    {"mass", "Mass", "kg", 0.001, 100.0, 0.4},         {"stiffness", "Cord stiffness", "N/m", 0.1, 1e5, 100.0},
    {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.05},
};

Cloth net_cloth(const Shape& shape) {
  Cloth cloth = upright_cloth(shape, shape["width"], shape.count("columns"));
  cloth.fabric.mass_model = MassModel::Equal;
  cloth.fabric.mass = shape["mass"];
  cloth.stencil = 4;
  return cloth;
}

ElementCount element_count(const Shape& shape) {
  ElementCount count = element_count_of(net_cloth(shape));
  count.faces = 0;
  return count;
}

// A cloth without faces and without texture coordinates.
void make(const Shape& shape, Network& network) {
  const std::size_t faces = network.faces.size(), cloth_coordinates = network.cloth_coordinates.size();
  add_nailed_cloth(shape, net_cloth(shape), network);
  network.faces.truncate(faces);
  network.cloth_coordinates.resize(cloth_coordinates);
}

}  // namespace

constinit const ShapeKind net_shape{.id = "net",
                                    .label = "Net",
                                    .description = "Cords between knots, without faces; every knot has the same mass.",
                                    .details = "A plain spring graph: `stiffness` and `damping` are those of each cord",
                                    .numbers = numbers,
                                    .supports = sheet_supports,
                                    .contact = ShapeContact::Springs,
                                    .element_count = element_count,
                                    .make = make};

}  // namespace hooke
