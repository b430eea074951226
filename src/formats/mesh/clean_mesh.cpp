#include "formats/mesh/clean_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

#include "base/errors.h"
#include "base/text_lines.h"
#include "formats/mesh/weld_vertices.h"

namespace hooke {
namespace {

constexpr double min_size = 1e-6;          // [m], of a mesh
constexpr double weld_ratio = 1e-6;        // of the mesh's size
constexpr double min_height_ratio = 1e-8;  // of a face, relative to its longest side: flatter faces have no area

class MeshCleaner {
 public:
  MeshCleaner(const Mesh& mesh, const std::string& file, std::vector<std::string>& notes) : mesh_(mesh), file_(file), notes_(notes) {}

  CleanMesh clean() {
    compute_bounds();
    weld_vertices();
    add_polygons();
    remove_duplicate_cells();
    renumber_points();
    report_changes();
    return std::move(clean_mesh_);
  }

 private:
  void compute_bounds();
  void weld_vertices();
  void add_polygons();
  void add_cell(std::span<const Index> corners);
  void choose_quad_diagonal(Cell& cell) const;
  double longest_side_of(const Cell& cell) const;
  void remove_duplicate_cells();
  void renumber_points();
  void report_changes();

  const Vec3& position(Index vertex) const { return mesh_.vertices[static_cast<std::size_t>(vertex)]; }
  Vec3 normal_of(Index a, Index b, Index c) const { return 0.5 * glm::cross(position(b) - position(a), position(c) - position(a)); }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(file_ + ": " + what); }

  const Mesh& mesh_;
  const std::string& file_;
  std::vector<std::string>& notes_;
  CleanMesh clean_mesh_;          // until renumber_points, its cells refer to vertices
  std::vector<Index> welded_to_;  // by vertex
  std::size_t welded_ = 0, degenerate_ = 0, duplicates_ = 0, triangulated_ = 0;
};

void MeshCleaner::compute_bounds() {
  if (mesh_.polygon_count() == 0) refuse("faces: none: there must be at least one");
  clean_mesh_.min = clean_mesh_.max = mesh_.vertices[0];
  for (const Vec3& x : mesh_.vertices) {
    clean_mesh_.min = glm::min(clean_mesh_.min, x);
    clean_mesh_.max = glm::max(clean_mesh_.max, x);
  }
  if (clean_mesh_.size() < min_size)
    refuse("size: " + format_rounded(clean_mesh_.size()) + " m: must be at least " + format_rounded(min_size));
}

void MeshCleaner::weld_vertices() {
  welded_to_ = weld(mesh_.vertices, weld_ratio * clean_mesh_.size());
  for (Index i = 0; i < static_cast<Index>(welded_to_.size()); ++i) welded_ += welded_to_[static_cast<std::size_t>(i)] != i ? 1 : 0;
}

void MeshCleaner::add_polygons() {
  std::vector<Index> corners;
  for (std::size_t i = 0; i < mesh_.polygon_count(); ++i) {
    // corners that have become equal by welding count once
    corners.clear();
    for (const Index vertex : mesh_.polygon(i)) {
      const Index corner = welded_to_[static_cast<std::size_t>(vertex)];
      if (corners.empty() || corners.back() != corner) corners.push_back(corner);
    }
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();

    if (corners.size() <= 4) {
      add_cell(corners);
    } else {
      ++triangulated_;
      for (std::size_t c = 1; c + 1 < corners.size(); ++c) add_cell(std::array{corners[0], corners[c], corners[c + 1]});
    }
  }
}

void MeshCleaner::add_cell(std::span<const Index> corners) {
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
    ++degenerate_;
  else
    clean_mesh_.cells.push_back(cell);
}

// Chooses the diagonal for which both halves have the same orientation, or the shorter one if both do.
void MeshCleaner::choose_quad_diagonal(Cell& cell) const {
  if (cell.size() != 4) return;
  const auto& [a, b, c, d] = cell.corners;
  const bool along_ac = glm::dot(normal_of(a, b, c), normal_of(a, c, d)) > 0.0;
  const bool along_bd = glm::dot(normal_of(a, b, d), normal_of(b, c, d)) > 0.0;
  const bool bd_is_shorter = glm::distance(position(b), position(d)) < glm::distance(position(a), position(c));
  if (along_bd && (!along_ac || bd_is_shorter)) std::rotate(cell.corners.begin(), cell.corners.begin() + 1, cell.corners.end());
}

double MeshCleaner::longest_side_of(const Cell& cell) const {
  double longest = 0.0;
  for (int c = 0; c < cell.size(); ++c)
    longest = std::max(longest, glm::distance(position(cell.corners[c]), position(cell.corners[(c + 1) % cell.size()])));
  return longest;
}

// Compares corners in any order: a duplicate would double stiffness and mass.
void MeshCleaner::remove_duplicate_cells() {
  struct Key {
    std::array<Index, 4> corners;
    std::size_t cell;
    bool operator<(const Key& other) const { return std::tie(corners, cell) < std::tie(other.corners, other.cell); }
  };
  std::vector<Key> keys;
  keys.reserve(clean_mesh_.cells.size());
  for (std::size_t i = 0; i < clean_mesh_.cells.size(); ++i) {
    keys.push_back({clean_mesh_.cells[i].corners, i});
    std::sort(keys.back().corners.begin(), keys.back().corners.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> is_duplicate(clean_mesh_.cells.size(), false);
  for (std::size_t k = 1; k < keys.size(); ++k) is_duplicate[keys[k].cell] = keys[k].corners == keys[k - 1].corners;

  std::size_t unique_count = 0;
  for (std::size_t i = 0; i < clean_mesh_.cells.size(); ++i)
    if (!is_duplicate[i]) clean_mesh_.cells[unique_count++] = clean_mesh_.cells[i];
  duplicates_ = clean_mesh_.cells.size() - unique_count;
  clean_mesh_.cells.resize(unique_count);
}

// Vertices that a face needs become points, in the order of the file.
void MeshCleaner::renumber_points() {
  if (clean_mesh_.cells.empty()) refuse("faces: none has an area: there must be at least one");
  std::vector<Index> point_of(mesh_.vertices.size(), no_index);
  for (const Cell& cell : clean_mesh_.cells)
    for (int c = 0; c < cell.size(); ++c) point_of[static_cast<std::size_t>(cell.corners[c])] = 0;
  for (std::size_t vertex = 0; vertex < point_of.size(); ++vertex) {
    if (point_of[vertex] == no_index) continue;
    point_of[vertex] = static_cast<Index>(clean_mesh_.points.size());
    clean_mesh_.points.push_back(mesh_.vertices[vertex]);
  }
  for (Cell& cell : clean_mesh_.cells)
    for (int c = 0; c < cell.size(); ++c) cell.corners[c] = point_of[static_cast<std::size_t>(cell.corners[c])];
}

void MeshCleaner::report_changes() {
  const auto report = [&](std::size_t count, const char* one, const char* many, const char* what) {
    if (count > 0) notes_.push_back(file_ + ": " + pluralize(count, one, many) + what);
  };
  const std::size_t unused = mesh_.vertices.size() - welded_ - clean_mesh_.points.size();
  report(welded_, "vertex is", "vertices are", " at the position of another: welded");
  report(degenerate_, "face has", "faces have", " no area: ignored");
  report(duplicates_, "face is a duplicate", "faces are duplicates", ": ignored");
  report(triangulated_, "face has", "faces have", " more than four corners: split into triangles from the first corner");
  report(unused, "vertex belongs", "vertices belong", " to no face: ignored");
}

}  // namespace

double CleanMesh::size() const { return glm::distance(min, max); }

CleanMesh clean_mesh(const Mesh& mesh, const std::string& file, std::vector<std::string>& notes) {
  return MeshCleaner(mesh, file, notes).clean();
}

}  // namespace hooke
