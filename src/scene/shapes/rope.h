// A rope: a row of points with springs between consecutive points.
#pragma once

#include "scene/shapes/fabric.h"

namespace hooke {

struct Rope {
  Vec3 from{0.0}, to{1.0, 0.0, 0.0};  // [m]
  std::int64_t points = 2;
  Fabric fabric;
};

ElementCount element_count_of(const Rope& rope);
void generate(const Rope& rope, Network& network);

}  // namespace hooke
