// Declarations of the shapes of list.inc. Each file of this folder defines one of them.
#pragma once

#include "scene/shape.h"

namespace hooke {

#define ROW(name) extern const ShapeKind name##_shape;
#include "scene/shapes/list.inc"
#undef ROW

}  // namespace hooke
