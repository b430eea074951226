// The faces and springs of a scene that touch, sorted by their present positions.
#pragma once

#include <vector>

#include "sim/contact/surface/surface_tree.h"
#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

struct PlacedSurface {
  SurfacePlan plan;
  std::vector<Vec3> place;  // [m], per point of the plan
  SurfaceTree tree;         // not built where nothing touches
};

inline PlacedSurface place_surface(const System& system, const State& state) {
  PlacedSurface surface{.plan = plan_surface(system), .place = {}, .tree = {}};
  if (!surface.plan.on) return surface;
  for (const Index i : surface.plan.points) surface.place.push_back(state.position[i]);
  surface.tree.build(surface.plan, surface.place);
  return surface;
}

}  // namespace hooke
