// Cloths that hang upright: sheets, curtains, flags and nets.
#pragma once

#include "scene/shapes/cloth.h"

namespace hooke {

inline constexpr std::string_view sheet_supports[] = {"top_corners", "corners", "edge", "ring", "nothing"};

// Centred at the origin, with the shape's height, rows, stiffness and damping.
Cloth upright_cloth(const Shape& shape, double width, std::int64_t columns);

// The cloth of a shape with width, columns and density as well.
Cloth sheet_cloth(const Shape& shape);

// Appends the cloth, nailed by the shape's support.
void add_nailed_cloth(const Shape& shape, Cloth cloth, Network& network);

}  // namespace hooke
