#include "formats/mesh/weld_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace hooke {

// In a grid of cubes with sides of four distances: everything within one distance of a position is in at most eight of them. Vertices that
// are kept are further apart than one distance, so the number of them in a cube is bounded.
std::vector<Index> weld(std::span<const Vec3> positions, double distance) {
  using Cube = std::array<double, 3>;
  const auto cube_at = [&](const Vec3& x) {
    Cube cube;
    for (int c = 0; c < 3; ++c) cube[c] = distance > 0.0 ? std::floor(x[c] / (4.0 * distance)) : x[c];
    return cube;
  };
  std::map<Cube, std::vector<Index>> kept;
  std::vector<Index> welded_to;
  welded_to.reserve(positions.size());
  for (Index i = 0; i < static_cast<Index>(positions.size()); ++i) {
    const Vec3& x = positions[i];
    std::array<Cube, 8> near;
    for (unsigned corner = 0; corner < 8; ++corner)
      near[corner] = cube_at(x + distance * Vec3(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0));
    std::ranges::sort(near);
    Index first = i;
    for (auto cube = near.begin(), end = std::unique(near.begin(), near.end()); cube != end; ++cube)
      if (const auto found = kept.find(*cube); found != kept.end())
        for (const Index j : found->second)
          if (j < first && glm::distance(positions[j], x) <= distance) first = j;
    welded_to.push_back(first);
    if (first == i) kept[cube_at(x)].push_back(i);
  }
  return welded_to;
}

}  // namespace hooke
