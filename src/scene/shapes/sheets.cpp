// Sheets, curtains, flags and nets: cloths (generators.h) hung up in one way or another.
#include <algorithm>
#include <cmath>

#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"

namespace hooke {
namespace {

constexpr std::string_view sheet_supports[] = {"top_corners", "corners", "edge", "ring", "nothing"};
constexpr std::string_view ring_supports[] = {"rings"}, pole_supports[] = {"pole"};

bool is_nailed_by_support(std::string_view support_name, std::int64_t column, std::int64_t row, std::int64_t columns, std::int64_t rows) {
  const bool at_side = column == 0 || column == columns - 1, at_top = row == 0, at_end = row == rows - 1;
  if (support_name == "top_corners") return at_top && at_side;
  if (support_name == "corners") return (at_top || at_end) && at_side;
  if (support_name == "edge") return at_top;
  if (support_name == "ring") return at_top || at_end || at_side;
  if (support_name == "pole") return column == 0;
  return false;
}

// Upright, its middle at the origin, of the shape's columns x rows points and other numbers that all cloths have.
Cloth upright_cloth(const Shape& shape, double width, std::int64_t columns) {
  Cloth cloth;
  cloth.corner = {-0.5 * width, 0.5 * shape["height"], 0.0};
  cloth.across = {width, 0.0, 0.0};
  cloth.down = {0.0, -shape["height"], 0.0};
  cloth.columns = columns;
  cloth.rows = shape.count("rows");
  cloth.fabric.stiffness = shape["stiffness"];
  cloth.fabric.damping = shape["damping"];
  return cloth;
}

// Appends the cloth, nailed as the shape is held.
void add_nailed_cloth(const Shape& shape, Cloth cloth, Network& network) {
  for (std::int64_t row = 0; row < cloth.rows; ++row)
    for (std::int64_t column = 0; column < cloth.columns; ++column)
      if (is_nailed_by_support(shape.support_name(), column, row, cloth.columns, cloth.rows))
        cloth.fabric.nails.push_back(static_cast<Index>(row * cloth.columns + column));
  generate(Generator(cloth), network);
}

// ---- sheet

constexpr ShapeNumber sheet_numbers[] = {
    {"width", "Width", "m", 0.05, 20.0, 1.0},          {"height", "Height", "m", 0.05, 20.0, 1.0},
    {"columns", "Columns", "", 2, 200, 24, true},      {"rows", "Rows", "", 2, 200, 24, true},
    {"density", "Density", "kg/m^2", 0.01, 10.0, 0.2}, {"stiffness", "Stiffness", "N/m", 0.1, 1e5, 60.0},
    {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.01},
};

Cloth sheet_cloth(const Shape& shape) {
  Cloth cloth = upright_cloth(shape, shape["width"], shape.count("columns"));
  cloth.fabric.density = shape["density"];
  return cloth;
}

ElementCount sheet_extent(const Shape& shape) { return element_count_of(Generator(sheet_cloth(shape))); }
void make_sheet(const Shape& shape, Network& network) { add_nailed_cloth(shape, sheet_cloth(shape), network); }

// ---- curtain

constexpr ShapeNumber curtain_numbers[] = {
    {"width", "Width of the rail", "m", 0.1, 20.0, 1.4},    {"height", "Height", "m", 0.05, 20.0, 1.2},
    {"fullness", "Cloth to rail", "times", 1.0, 3.0, 1.5},  {"rings", "Rings", "", 2, 60, 9, true},
    {"fold", "Columns to half a fold", "", 1, 10, 2, true}, {"rows", "Rows", "", 2, 200, 24, true},
    {"density", "Density", "kg/m^2", 0.01, 10.0, 0.2},      {"stiffness", "Stiffness", "N/m", 0.1, 1e5, 60.0},
    {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.01},
};

std::int64_t curtain_columns(const Shape& shape) { return 2 * shape.count("fold") * (shape.count("rings") - 1) + 1; }

Cloth curtain_cloth(const Shape& shape) {
  Cloth cloth = upright_cloth(shape, std::max(1.0, shape["fullness"]) * shape["width"], curtain_columns(shape));
  cloth.fabric.density = shape["density"];
  return cloth;
}

ElementCount curtain_extent(const Shape& shape) {
  ElementCount element_count = element_count_of(Generator(curtain_cloth(shape)));
  element_count.points += static_cast<std::uint64_t>(shape.count("rings"));
  element_count.springs += static_cast<std::uint64_t>(shape.count("rings"));
  return element_count;
}

// The flat cloth is folded along its columns, to one side and the other between two rings, which strains nothing:
//   o   /\      o     seen from above
//    \/    \  /
void make_curtain(const Shape& shape, Network& network) {
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

  // rings: nails on the rail, a little above the cloth
  const double above = 0.04 * shape["height"], radius = 0.25 * above;
  for (std::int64_t ring = 0; ring < shape.count("rings"); ++ring) {
    const std::size_t top = builder.first() + static_cast<std::size_t>(2 * fold * ring);
    const std::size_t nail = builder.add_point(network.position[top] + Vec3(0.0, above, 0.0), network.points[top].mass, radius, true);
    builder.add_spring(nail, top, 2.0 * shape["stiffness"], shape["damping"]);
  }
}

// ---- flag

constexpr ShapeNumber flag_numbers[] = {
    {"width", "Width", "m", 0.05, 20.0, 1.2},
    {"height", "Height", "m", 0.05, 20.0, 0.8},
    {"columns", "Columns", "", 2, 200, 30, true},
    {"rows", "Rows", "", 2, 200, 20, true},
    {"pole", "Pole", "m", 0.1, 40.0, 2.0},
    {"density", "Density", "kg/m^2", 0.01, 10.0, 0.12},
    {"stiffness", "Stiffness", "N/m", 0.1, 1e5, 60.0},
    {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.01},
};

ElementCount flag_extent(const Shape& shape) {
  ElementCount element_count = sheet_extent(shape);
  element_count.points += 2;
  element_count.springs += 1;
  return element_count;
}

// The pole ends a little above the cloth that is sewn to it.
void make_flag(const Shape& shape, Network& network) {
  make_sheet(shape, network);
  ShapeBuilder builder(network);
  const double pole_x = -0.5 * shape["width"] - 0.01, top = 0.5 * shape["height"] + 0.04;
  const std::size_t head = builder.add_point({pole_x, top, 0.0}, 1.0, 0.02, true);
  const std::size_t foot = builder.add_point({pole_x, top - shape["pole"], 0.0}, 1.0, 0.02, true);
  builder.add_spring(head, foot, shape["stiffness"], shape["damping"]);
}

// ---- net

constexpr ShapeNumber net_numbers[] = {
    {"width", "Width", "m", 0.05, 20.0, 1.6},          {"height", "Height", "m", 0.05, 20.0, 0.8},
    {"columns", "Columns", "", 2, 200, 17, true},      {"rows", "Rows", "", 2, 200, 9, true},
    {"mass", "Mass", "kg", 0.001, 100.0, 0.4},         {"stiffness", "Of each cord", "N/m", 0.1, 1e5, 100.0},
    {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.05},
};

Cloth net_cloth(const Shape& shape) {
  Cloth cloth = upright_cloth(shape, shape["width"], shape.count("columns"));
  cloth.fabric.mass_model = MassModel::Equal;
  cloth.fabric.mass = shape["mass"];
  cloth.stencil = 4;
  return cloth;
}

ElementCount net_extent(const Shape& shape) {
  ElementCount element_count = element_count_of(Generator(net_cloth(shape)));
  element_count.faces = 0;
  return element_count;
}

// A cloth that one can see through.
void make_net(const Shape& shape, Network& network) {
  const std::size_t faces = network.faces.size(), cloth_coordinates = network.cloth_coordinates.size();
  add_nailed_cloth(shape, net_cloth(shape), network);
  network.faces.resize(faces);
  network.cloth_coordinates.resize(cloth_coordinates);
}

}  // namespace

constinit const ShapeKind sheet_shape{
    .id = "sheet",
    .label = "Sheet",
    .description = "A sheet of cloth by its corners, an edge, all around or by nothing, the same stuff at every number of points.",
    .numbers = sheet_numbers,
    .supports = sheet_supports,
    .is_3d_only = false,
    .element_count = sheet_extent,
    .make = make_sheet};
constinit const ShapeKind curtain_shape{.id = "curtain",
                                        .label = "Curtain with rings",
                                        .description = "A sheet in folds that hangs by rings from a rail.",
                                        .numbers = curtain_numbers,
                                        .supports = ring_supports,
                                        .is_3d_only = true,
                                        .element_count = curtain_extent,
                                        .make = make_curtain};
constinit const ShapeKind flag_shape{.id = "flag",
                                     .label = "Flag on a pole",
                                     .description = "A sheet sewn to a pole by its left edge; it wants a wind.",
                                     .numbers = flag_numbers,
                                     .supports = pole_supports,
                                     .is_3d_only = false,
                                     .element_count = flag_extent,
                                     .make = make_flag};
constinit const ShapeKind net_shape{.id = "net",
                                    .label = "Net",
                                    .description = "Cords from knot to knot, no cloth between, every knot of the same mass.",
                                    .numbers = net_numbers,
                                    .supports = sheet_supports,
                                    .is_3d_only = false,
                                    .element_count = net_extent,
                                    .make = make_net};

}  // namespace hooke
