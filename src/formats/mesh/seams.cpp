#include "formats/mesh/seams.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "base/round_number.h"
#include "formats/mesh/weld_vertices.h"

namespace hooke {
namespace {

constexpr double gap_ratio = 1e-4;  // relative to the mean open edge, rounded down: coordinates have about four digits
constexpr std::size_t max_edges = 100'000;

std::size_t count_t_junctions(const CleanMesh& mesh, const std::vector<std::array<Index, 2>>& edges, std::vector<Index> points,
                              double gap) {
  const auto position = [&](Index i) { return mesh.points[static_cast<std::size_t>(i)]; };
  const Vec3 size = mesh.max - mesh.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::sort(points.begin(), points.end(), [&](Index i, Index j) { return position(i)[axis] < position(j)[axis]; });

  std::vector<bool> is_junction(mesh.points.size(), false);
  for (const auto& [first, second] : edges) {
    const Vec3 a = position(first), edge = position(second) - a;
    const double length = glm::length(edge), low = std::min(a[axis], a[axis] + edge[axis]), high = std::max(a[axis], a[axis] + edge[axis]);
    auto point = std::lower_bound(points.begin(), points.end(), low - gap, [&](Index i, double x) { return position(i)[axis] < x; });
    for (; point != points.end() && position(*point)[axis] <= high + gap; ++point) {
      const Vec3 offset = position(*point) - a;
      const double along = glm::dot(offset, edge) / length;
      if (along > gap && along < length - gap && glm::distance(offset, along / length * edge) <= gap)
        is_junction[static_cast<std::size_t>(*point)] = true;
    }
  }
  return static_cast<std::size_t>(std::count(is_junction.begin(), is_junction.end(), true));
}

}  // namespace

std::vector<std::array<Index, 2>> open_edges_of(const std::vector<Cell>& cells) {
  std::vector<std::array<Index, 2>> sides;
  for (const Cell& cell : cells)
    for (int c = 0; c < cell.size(); ++c) {
      const auto [first, second] = std::minmax(cell.corners[c], cell.corners[(c + 1) % cell.size()]);
      sides.push_back({first, second});
    }
  std::sort(sides.begin(), sides.end());
  std::vector<std::array<Index, 2>> open;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end] == sides[begin]) ++end;
    if (end == begin + 1) open.push_back(sides[begin]);
  }
  return open;
}

std::vector<Index> vertices_of(const std::vector<std::array<Index, 2>>& edges) {
  std::set<Index> vertices;
  for (const auto& edge : edges) vertices.insert(edge.begin(), edge.end());
  return {vertices.begin(), vertices.end()};
}

Seams find_seams(const CleanMesh& mesh) {
  const auto edges = open_edges_of(mesh.cells);
  const std::vector<Index> ends = vertices_of(edges);
  Seams seams;
  if (edges.empty()) return seams;
  std::vector<Vec3> positions;
  double mean_length = 0.0;
  for (const auto& [a, b] : edges)
    mean_length += glm::distance(mesh.points[static_cast<std::size_t>(a)], mesh.points[static_cast<std::size_t>(b)]) /
                   static_cast<double>(edges.size());
  seams.gap = round_below(gap_ratio * mean_length);
  for (const Index i : ends) positions.push_back(mesh.points[static_cast<std::size_t>(i)]);
  const std::vector<Index> welded_to = weld(positions, seams.gap);
  for (std::size_t i = 0; i < welded_to.size(); ++i) seams.points += welded_to[i] != static_cast<Index>(i) ? 1 : 0;
  if (edges.size() <= max_edges) seams.t_junctions = count_t_junctions(mesh, edges, ends, seams.gap);
  return seams;
}

}  // namespace hooke
