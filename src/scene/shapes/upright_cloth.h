// Cloths that hang upright: sheets, curtains, flags and nets.
#pragma once

#include "scene/shapes/cloth.h"

namespace hooke {

inline constexpr std::string_view sheet_supports[] = {"top_corners", "corners", "edge", "ring", "nothing"};

// Centered at the origin, with the height, rows, stiffness and damping of the shape.
Cloth upright_cloth(const Shape& shape, double width, std::int64_t columns);

// The cloth of a shape that also has width, columns and density.
Cloth sheet_cloth(const Shape& shape);

// Appends the cloth, nailed according to the support of the shape.
void add_nailed_cloth(const Shape& shape, Cloth cloth, Network& network);

}  // namespace hooke
