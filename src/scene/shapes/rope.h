// A rope: a row of points with springs between consecutive points.
#pragma once

#include "scene/shapes/fabric.h"

namespace hooke {

inline constexpr ShapeNumber cable_number{
    .name = "cable", .label = "Only pulls (0 or 1)", .unit = "", .min = 0, .max = 1, .default_value = 0, .integer = true, .max_integer = 1};

struct Rope {
  Vec3 from{0.0}, to{1.0, 0.0, 0.0};  // [m]
  std::int64_t points = 2;
  Fabric fabric;
  bool is_cable = false;  // whether its springs only pull
};

ElementCount element_count_of(const Rope& rope);
void generate(const Rope& rope, Network& network);

}  // namespace hooke
