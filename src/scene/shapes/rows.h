// The rows of the table of shapes, each in the file of its family.
#pragma once

#include "scene/shape.h"

namespace hooke {

extern const ShapeKind hanging_rope_shape, chain_shape;                    // lines.cpp
extern const ShapeKind sheet_shape, curtain_shape, flag_shape, net_shape;  // sheets.cpp
extern const ShapeKind bridge_shape;                                       // bridge.cpp
extern const ShapeKind jelly_shape;                                        // jelly.cpp

}  // namespace hooke
