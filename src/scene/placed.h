// Points, springs and faces with their indices in the lists of a scene, for insertion and restoration.
#pragma once

#include "sim/model/system.h"

namespace hooke {

// A point or spring, its index in the list, and its weights in a sheet (SheetWeights).
struct PlacedPoint {
  Index at = no_index;  // no_index: at the end
  Point point;
  Vec3 position{0.0}, velocity{0.0};
  double area = 0.0;  // [m^2]; 0: not part of a sheet
  bool operator==(const PlacedPoint&) const = default;
};
struct PlacedSpring {
  Index at = no_index;
  Spring spring;
  double sheet_weight = 0.0;  // [1]; 0: not part of a sheet
  bool operator==(const PlacedSpring&) const = default;
};
struct PlacedFace {
  Index at = no_index;
  Face face;
  bool operator==(const PlacedFace&) const = default;
};

}  // namespace hooke
