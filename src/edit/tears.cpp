#include "edit/tears.h"

#include <algorithm>

namespace hooke {

Remove removal_of_broken(const System& system, std::span<const SpringId> broken) {
  Remove torn;
  std::vector<std::pair<PointId, PointId>> edges;
  for (const SpringId id : broken) {
    const Index s = system.index_of(id);
    if (s == no_index) continue;
    const Spring& spring = system.springs()[s];
    torn.springs.push_back(id);
    edges.push_back(std::minmax(spring.first, spring.second));
  }
  std::sort(edges.begin(), edges.end());
  const auto is_torn = [&](PointId a, PointId b) {
    return std::binary_search(edges.begin(), edges.end(), std::pair(std::min(a, b), std::max(a, b)));
  };
  for (const Face& face : system.faces) {
    const auto& [a, b, c] = face.points;
    if (is_torn(a, b) || is_torn(b, c) || is_torn(c, a)) torn.faces.push_back(face);
  }
  return torn;
}

// The index of a tear is higher than those of all tears before it: walk back from the higher index until both paths meet.
TearPath path_between(const Scene& scene, std::uint32_t from, std::uint32_t to) {
  TearPath path;
  while (from != to) {
    std::uint32_t& later = from > to ? from : to;
    (from > to ? path.undone : path.torn).push_back(later);
    later = scene.tears[later - 1]->before;
  }
  std::ranges::reverse(path.torn);
  return path;
}

Insert restored_by_undo(const Tear& tear) { return {.points = {}, .springs = tear.springs, .faces = tear.faces}; }

Remove removal_of_tear(const Tear& tear) {
  Remove remove;
  for (const PlacedSpring& placed : tear.springs) remove.springs.push_back(placed.spring.id);
  for (const PlacedFace& placed : tear.faces) remove.faces.push_back(placed.face);
  return remove;
}

}  // namespace hooke
