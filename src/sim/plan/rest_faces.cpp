#include "sim/plan/rest_faces.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/plan/constants.h"

namespace hooke {

RestFace rest_face(const System& system, const RestLengths& lengths, const Face& face) {
  RestFace rest;
  for (int c = 0; c < 3; ++c) rest.corners[c] = system.index_of(face.points[c]);
  auto& l = rest.length;
  int missing = 0;
  for (int c = 0; c < 3; ++c) {
    l[c] = lengths.between(rest.corners[(c + 1) % 3], rest.corners[(c + 2) % 3]);
    missing += l[c] == 0.0 ? 1 : 0;
  }
  if (missing > 1) return rest;
  for (int c = 0; c < 3; ++c)
    if (l[c] == 0.0) l[c] = std::sqrt(l[(c + 1) % 3] * l[(c + 1) % 3] + l[(c + 2) % 3] * l[(c + 2) % 3]);

  // Heron's formula
  const double s = 0.5 * (l[0] + l[1] + l[2]), square = s * (s - l[0]) * (s - l[1]) * (s - l[2]), max = std::max({l[0], l[1], l[2]});
  const double area = square > 0.0 ? std::sqrt(square) : 0.0;
  if (!(2.0 * area > min_relative_height * max * max) || !(area > min_rest_area) || !(area < max_rest_area)) return rest;
  rest.area = area;
  for (int c = 0; c < 3; ++c) {
    const double a = l[(c + 1) % 3], b = l[(c + 2) % 3];
    rest.cotangent[c] = (a * a + b * b - l[c] * l[c]) / (4.0 * area);
  }
  return rest;
}

std::vector<FaceEdge> sorted_edges(const System& system) {
  std::vector<FaceEdge> edges;
  edges.reserve(3 * system.faces.size());
  for (std::size_t f = 0; f < system.faces.size(); ++f)
    for (int c = 0; c < 3; ++c) {
      const auto point = [&, face = system.faces[f]](int next) { return system.index_of(face.points[(c + next) % 3]); };
      edges.push_back({edge_ends(point(1), point(2)), static_cast<Index>(f), c, point(0), point(1)});
    }
  std::ranges::sort(edges, {}, [](const FaceEdge& edge) { return std::tuple(edge.ends, edge.face, edge.corner); });
  return edges;
}

}  // namespace hooke
