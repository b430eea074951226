#include "formats/mesh/clean_mesh.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>
#include <vector>

#include "base/errors.h"
#include "base/round_number.h"
#include "base/text_lines.h"
#include "formats/mesh/triangulate.h"
#include "formats/mesh/weld_vertices.h"

namespace hooke {
namespace {

struct Seams {
  double gap = 0.0;             // [m], about 1e-4 of the mean length of the open edges
  std::size_t points = 0;       // ends of open edges that are within the gap of another one
  std::size_t t_junctions = 0;  // ends of open edges that are within the gap of an open edge, between its ends
};

constexpr double gap_ratio = 1e-4;  // relative to the mean open edge, rounded down: coordinates have about four digits
constexpr std::size_t max_edges = 100'000;

std::size_t count_t_junctions(const CleanMesh& mesh, const std::vector<std::array<Index, 2>>& edges, std::vector<Index> points,
                              double gap) {
  const auto position = [&](Index i) { return mesh.points[i]; };
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
      if (along > gap && along < length - gap && glm::distance(offset, along / length * edge) <= gap) is_junction[*point] = true;
    }
  }
  return static_cast<std::size_t>(std::count(is_junction.begin(), is_junction.end(), true));
}

// The sides that belong to one cell, with the smaller index first, sorted.
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

// Their ends, sorted.
std::vector<Index> vertices_of(const std::vector<std::array<Index, 2>>& edges) {
  std::set<Index> vertices;
  for (const auto& edge : edges) vertices.insert(edge.begin(), edge.end());
  return {vertices.begin(), vertices.end()};
}

// T-junctions are counted in meshes with up to 100,000 open edges.
Seams find_seams(const CleanMesh& mesh) {
  const auto edges = open_edges_of(mesh.cells);
  const std::vector<Index> ends = vertices_of(edges);
  Seams seams;
  if (edges.empty()) return seams;
  std::vector<Vec3> positions;
  double mean_length = 0.0;
  for (const auto& [a, b] : edges) mean_length += glm::distance(mesh.points[a], mesh.points[b]) / static_cast<double>(edges.size());
  seams.gap = round_below(gap_ratio * mean_length);
  for (const Index i : ends) positions.push_back(mesh.points[i]);
  const std::vector<Index> welded_to = weld(positions, seams.gap);
  for (std::size_t i = 0; i < welded_to.size(); ++i) seams.points += welded_to[i] != static_cast<Index>(i) ? 1 : 0;
  if (edges.size() <= max_edges) seams.t_junctions = count_t_junctions(mesh, edges, ends, seams.gap);
  return seams;
}

constexpr double min_size = 1e-6;            // [m], of a mesh
constexpr double weld_ratio = 1e-6;          // relative to the size of the mesh
constexpr double max_plausible_size = 50.0;  // [m], along an axis: larger meshes are often in millimeters
constexpr double min_height_ratio = 1e-8;    // height of a triangle over its longest edge: flatter ones are degenerate

// Smallest and largest coordinates of the listed positions.
std::pair<Vec3, Vec3> bounds_of(const std::vector<Vec3>& positions) {
  std::pair bounds(positions[0], positions[0]);
  for (const Vec3& x : positions) bounds = {glm::min(bounds.first, x), glm::max(bounds.second, x)};
  return bounds;
}

class MeshCleaner {
 public:
  MeshCleaner(const Mesh& mesh, const std::string& file, std::vector<std::string>& notes) : mesh_(mesh), file_(file), notes_(notes) {}

  CleanMesh clean(double seam_distance) {
    find_used_vertices();
    weld_vertices();
    add_polygons();
    if (seam_distance > 0.0) {
      weld_seams(seam_distance);
      add_polygons();
    }
    remove_duplicate_cells();
    add_lines();
    renumber_points();
    report_changes();
    return std::move(clean_mesh_);
  }

 private:
  // Another vertex affects neither the size nor the distance of welding.
  void find_used_vertices() {
    std::vector<bool> is_used(mesh_.vertices.size(), false);
    for (const Index corner : mesh_.corners) is_used[corner] = true;
    for (const auto& line : mesh_.lines)
      for (const Index end : line) is_used[end] = true;
    for (const Index point : mesh_.lone_points) is_used[point] = true;
    for (Index i = 0; i < static_cast<Index>(is_used.size()); ++i)
      if (is_used[i]) used_.push_back(i);
    if (used_.empty()) refuse("faces and lines: none: there must be at least one");
  }

  void weld_vertices() {
    std::vector<Vec3> positions;
    for (const Index i : used_) positions.push_back(position(i));
    const auto [min, max] = bounds_of(positions);
    const double size = glm::distance(min, max);
    if (size < min_size) refuse("size: " + format_rounded(size) + " m: must be at least " + format_rounded(min_size));
    welded_to_.resize(mesh_.vertices.size());
    for (std::size_t i = 0; i < welded_to_.size(); ++i) welded_to_[i] = static_cast<Index>(i);
    weld_within(used_, weld_ratio * size);
  }

  void weld_seams(double distance) {
    weld_within(vertices_of(open_edges_of(clean_mesh_.cells)), distance);
    for (const Index i : used_) welded(i) = welded(welded(i));
    clean_mesh_.cells.clear();
    changes_ = {};
  }

  void weld_within(const std::vector<Index>& vertices, double distance) {
    std::vector<Vec3> positions;
    for (const Index i : vertices) positions.push_back(position(i));
    const std::vector<Index> welded_to = weld(positions, distance);
    for (std::size_t k = 0; k < vertices.size(); ++k) welded(vertices[k]) = vertices[welded_to[k]];
  }

  void add_polygons() {
    std::vector<Index> corners;
    std::vector<Vec3> positions;
    std::vector<std::array<Index, 3>> triangles;
    for (std::size_t i = 0; i < mesh_.polygon_count(); ++i) {
      // corners that have become equal by welding count once
      corners.clear();
      for (const Index vertex : mesh_.polygon(i))
        if (const Index corner = welded(vertex); corners.empty() || corners.back() != corner) corners.push_back(corner);
      while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
      if (corners.size() <= 4) {
        add_cell(corners);
        continue;
      }

      positions.clear();
      triangles.clear();
      for (const Index corner : corners) positions.push_back(position(corner));
      ++changes_.triangulated;
      if (!triangulate(positions, triangles)) ++changes_.crossing;
      for (const auto& [a, b, c] : triangles) add_cell(std::array{corners[a], corners[b], corners[c]});
    }
  }

  void add_cell(std::span<const Index> corners) {
    Cell cell;
    std::copy(corners.begin(), corners.end(), cell.corners.begin());
    bool is_degenerate = corners.size() < 3;
    for (std::size_t a = 0; a < corners.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) is_degenerate = is_degenerate || corners[a] == corners[b];
    if (!is_degenerate) {
      choose_quad_diagonal(cell);
      const auto& [a, b, c, d] = cell.corners;
      cell.area = glm::length(normal_of(a, b, c)) + (cell.size() == 4 ? glm::length(normal_of(a, c, d)) : 0.0);
      const double longest = longest_side_of(cell);
      is_degenerate = !(cell.area > min_height_ratio * longest * longest);
    }
    if (is_degenerate)
      ++changes_.degenerate;
    else
      clean_mesh_.cells.push_back(cell);
  }

  // The diagonal is from the first corner to the third, unless only for the other one both halves have the same orientation.
  void choose_quad_diagonal(Cell& cell) const {
    if (cell.size() != 4) return;
    const auto& [a, b, c, d] = cell.corners;
    const bool along_ac = glm::dot(normal_of(a, b, c), normal_of(a, c, d)) > 0.0;
    const bool along_bd = glm::dot(normal_of(a, b, d), normal_of(b, c, d)) > 0.0;
    if (along_bd && !along_ac) std::rotate(cell.corners.begin(), cell.corners.begin() + 1, cell.corners.end());
  }

  double longest_side_of(const Cell& cell) const {
    double longest = 0.0;
    for (int c = 0; c < cell.size(); ++c)
      longest = std::max(longest, glm::distance(position(cell.corners[c]), position(cell.corners[(c + 1) % cell.size()])));
    return longest;
  }

  // Compares corners in any order: a duplicate would double stiffness and mass.
  void remove_duplicate_cells() {
    std::set<std::array<Index, 4>> seen;
    changes_.duplicates = std::erase_if(clean_mesh_.cells, [&](const Cell& cell) {
      std::array<Index, 4> corners = cell.corners;
      std::ranges::sort(corners);
      return !seen.insert(corners).second;
    });
  }

  // Lines without length, and further lines between the same two vertices, are dropped.
  void add_lines() {
    std::set<std::pair<Index, Index>> seen;
    for (const auto& [first, second] : mesh_.lines) {
      const auto [a, b] = std::minmax({welded(first), welded(second)});
      if (a != b && seen.emplace(a, b).second) clean_mesh_.lines.push_back({a, b});
    }
    changes_.lines = mesh_.lines.size() - clean_mesh_.lines.size();
  }

  // Vertices that are needed become points, in the order of the file.
  void renumber_points() {
    if (clean_mesh_.cells.empty() && clean_mesh_.lines.empty() && mesh_.lone_points.empty())
      refuse("faces: none has an area: there must be at least one");
    std::vector<Index> point_of(mesh_.vertices.size(), no_index);
    const auto for_each_reference = [&](const auto& use) {
      for (Cell& cell : clean_mesh_.cells)
        for (int c = 0; c < cell.size(); ++c) use(cell.corners[c]);
      for (auto& line : clean_mesh_.lines)
        for (Index& end : line) use(end);
    };
    for_each_reference([&](Index vertex) { point_of[vertex] = 0; });
    for (const Index vertex : mesh_.lone_points) point_of[welded(vertex)] = 0;
    for (std::size_t vertex = 0; vertex < point_of.size(); ++vertex) {
      if (point_of[vertex] == no_index) continue;
      point_of[vertex] = static_cast<Index>(clean_mesh_.points.size());
      clean_mesh_.points.push_back(mesh_.vertices[vertex]);
    }
    for_each_reference([&](Index& vertex) { vertex = point_of[vertex]; });
    std::tie(clean_mesh_.min, clean_mesh_.max) = bounds_of(clean_mesh_.points);
  }

  void report_changes() {
    const auto report = [&](std::size_t count, const char* one, const char* many, const std::string& what) {
      if (count > 0) notes_.push_back(file_ + ": " + pluralize(count, one, many) + what);
    };
    std::size_t welded_vertices = 0;
    for (const Index i : used_) welded_vertices += welded(i) != i ? 1 : 0;
    const std::size_t unused = mesh_.vertices.size() - welded_vertices - clean_mesh_.points.size();
    report(welded_vertices, "vertex is", "vertices are", " at the position of another: welded");
    report(changes_.degenerate, "face has", "faces have", " no area: ignored");
    report(changes_.duplicates, "face is a duplicate", "faces are duplicates", ": ignored");
    report(changes_.lines, "line is a duplicate or has", "lines are duplicates or have", " no length: ignored");
    report(changes_.triangulated, "face has", "faces have", " more than four corners: split into triangles");
    report(changes_.crossing, "face crosses itself", "faces cross themselves", ": the area is not that of the outline");
    report(unused, "vertex belongs", "vertices belong", " to no face or line: ignored");

    const Seams seams = find_seams(clean_mesh_);
    const std::string gap = format_rounded(1000.0 * seams.gap) + " mm";
    report(seams.points, "point on an open edge is", "points on open edges are",
           " within " + gap + " of others: not joined (--weld " + format_rounded(seams.gap) + ")");
    report(seams.t_junctions, "point lies", "points lie", " on an open edge between its ends: not joined");
    if (const Vec3 size = clean_mesh_.max - clean_mesh_.min; std::max({size.x, size.y, size.z}) > max_plausible_size)
      notes_.push_back(file_ + ": size: " + format_size(size) + ": millimeters? (--scale 0.001)");
  }

  const Vec3& position(Index vertex) const { return mesh_.vertices[vertex]; }
  Index& welded(Index vertex) { return welded_to_[vertex]; }
  Vec3 normal_of(Index a, Index b, Index c) const { return 0.5 * glm::cross(position(b) - position(a), position(c) - position(a)); }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(file_ + ": " + what); }

  // Numbers of what was changed.
  struct Changes {
    std::size_t degenerate = 0, duplicates = 0, triangulated = 0, crossing = 0, lines = 0;
  };

  const Mesh& mesh_;
  const std::string& file_;
  std::vector<std::string>& notes_;
  CleanMesh clean_mesh_;          // until renumber_points, its cells and lines refer to vertices
  std::vector<Index> used_;       // vertices of faces, lines and points, in order
  std::vector<Index> welded_to_;  // by vertex
  Changes changes_;
};

}  // namespace

double CleanMesh::size() const { return glm::distance(min, max); }

std::string format_size(const Vec3& size) {
  return format_rounded(size.x) + " x " + format_rounded(size.y) + " x " + format_rounded(size.z) + " m";
}

CleanMesh clean_mesh(const Mesh& mesh, double seam_distance, const std::string& file, std::vector<std::string>& notes) {
  return MeshCleaner(mesh, file, notes).clean(seam_distance);
}

}  // namespace hooke
