#pragma once

#include "sim/model/system.h"

namespace hooke {

// Projects to the plane of a two-dimensional scene.
inline Vec3 in_plane(const System& system, Vec3 v) {
  if (system.dimensions == 2) v.z = 0.0;
  return v;
}

}  // namespace hooke
