#pragma once

#include <cmath>

#include "base/types.h"

namespace hooke {

// Whether no component is infinite or NaN.
inline bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace hooke
