#include "scene/shapes/upright_cloth.h"

namespace hooke {
namespace {

bool is_nailed_by_support(std::string_view support_name, std::int64_t column, std::int64_t row, std::int64_t columns, std::int64_t rows) {
  const bool at_side = column == 0 || column == columns - 1, at_top = row == 0, at_end = row == rows - 1;
  if (support_name == "top_corners") return at_top && at_side;
  if (support_name == "corners") return (at_top || at_end) && at_side;
  if (support_name == "edge") return at_top;
  if (support_name == "ring") return at_top || at_end || at_side;
  if (support_name == "pole") return column == 0;
  return false;
}

}  // namespace

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

Cloth sheet_cloth(const Shape& shape) {
  Cloth cloth = upright_cloth(shape, shape["width"], shape.count("columns"));
  cloth.fabric.density = shape["density"];
  return cloth;
}

void add_nailed_cloth(const Shape& shape, Cloth cloth, Network& network) {
  for (std::int64_t row = 0; row < cloth.rows; ++row)
    for (std::int64_t column = 0; column < cloth.columns; ++column)
      if (is_nailed_by_support(shape.support_name(), column, row, cloth.columns, cloth.rows))
        cloth.fabric.nails.push_back(static_cast<Index>(row * cloth.columns + column));
  generate(cloth, network);
}

}  // namespace hooke
