// Mass and radius of a point that is added by hand.
#pragma once

#include "scene/scene.h"

namespace hooke {

struct NewPoint {
  double mass = 1.0;     // [kg]
  double radius = 0.02;  // [m]
};

// What the defaults give; where they are 0, the median of the points that no spring or face holds, such as balls, else of all points. For
// a scene without points, 1 kg and 20 mm.
NewPoint new_point_like(const Defaults& defaults, const System& system);

// Of a point that is attached to `neighbor`: what the defaults give, else as the neighbor.
NewPoint new_point_like(const Defaults& defaults, const Point& neighbor);

}  // namespace hooke
