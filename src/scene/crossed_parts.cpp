#include "scene/crossed_parts.h"

#include "sim/contact/surface/surface_tree.h"

namespace hooke {

CrossedParts find_crossed_parts(const System& system, const State& state) {
  CrossedParts parts;
  if (!system.contact.faces || system.dimensions == 2) return parts;
  const SurfacePlan plan = plan_surface(system);
  if (!plan.on) return parts;
  std::vector<Vec3> place;
  for (const Index i : plan.points) place.push_back(state.position[i]);
  SurfaceTree tree;
  tree.build(plan, place);
  const auto [crossings, is_complete] = tree.find_crossings(place);
  parts.is_complete = is_complete;
  const auto id_of = [&](Index point) { return system.points()[plan.points[point]].id; };
  for (const auto& [edge, face] : crossings) {
    const auto& [p, q] = plan.edges[edge];
    const auto& [a, b, c] = plan.pieces[face].points;
    parts.edges.push_back({id_of(p), id_of(q)});
    parts.faces.push_back({id_of(a), id_of(b), id_of(c)});
  }
  return parts;
}

}  // namespace hooke
