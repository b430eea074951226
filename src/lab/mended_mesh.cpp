#include "lab/mended_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

#include "lab/text_lines.h"
#include "lab/weld.h"
#include "sim/errors.h"

namespace hooke {
namespace {

constexpr double least_size = 1e-6;          // [m], of a mesh
constexpr double weld_ratio = 1e-6;          // of the mesh's size
constexpr double least_height_ratio = 1e-8;  // of a face, by its longest side: flatter ones have no area

class Mender {
 public:
  Mender(const Mesh& mesh, const std::string& file, std::vector<std::string>& notes) : mesh_(mesh), file_(file), notes_(notes) {}

  MendedMesh mend() {
    measure();
    weld_vertices();
    take_polygons();
    drop_repeated_cells();
    number_points();
    note_all();
    return std::move(mended_);
  }

 private:
  void measure();
  void weld_vertices();
  void take_polygons();
  void take_cell(std::span<const Index> corners);
  void turn_quad(Cell& cell) const;
  double longest_side_of(const Cell& cell) const;
  void drop_repeated_cells();
  void number_points();
  void note_all();

  const Vec3& position(Index vertex) const { return mesh_.vertices[static_cast<std::size_t>(vertex)]; }
  Vec3 normal_of(Index a, Index b, Index c) const { return 0.5 * glm::cross(position(b) - position(a), position(c) - position(a)); }
  [[noreturn]] void refuse(const std::string& what) const { throw Refused(file_ + ": " + what); }

  const Mesh& mesh_;
  const std::string& file_;
  std::vector<std::string>& notes_;
  MendedMesh mended_;             // until number_points, its cells are of vertices
  std::vector<Index> welded_to_;  // by vertex
  std::size_t welded_ = 0, flat_ = 0, repeated_ = 0, cut_ = 0;
};

void Mender::measure() {
  if (mesh_.polygon_count() == 0) refuse("faces: none: there must be at least one");
  mended_.least = mended_.most = mesh_.vertices[0];
  for (const Vec3& x : mesh_.vertices) {
    mended_.least = glm::min(mended_.least, x);
    mended_.most = glm::max(mended_.most, x);
  }
  if (mended_.size() < least_size) refuse("size: " + short_text(mended_.size()) + " m: must be at least " + short_text(least_size));
}

void Mender::weld_vertices() {
  welded_to_ = weld(mesh_.vertices, weld_ratio * mended_.size());
  for (Index i = 0; i < static_cast<Index>(welded_to_.size()); ++i) welded_ += welded_to_[static_cast<std::size_t>(i)] != i ? 1 : 0;
}

void Mender::take_polygons() {
  std::vector<Index> corners;
  for (std::size_t i = 0; i < mesh_.polygon_count(); ++i) {
    // corners that became one by welding are one
    corners.clear();
    for (const Index vertex : mesh_.polygon(i)) {
      const Index corner = welded_to_[static_cast<std::size_t>(vertex)];
      if (corners.empty() || corners.back() != corner) corners.push_back(corner);
    }
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();

    if (corners.size() <= 4) {
      take_cell(corners);
    } else {
      ++cut_;
      for (std::size_t c = 1; c + 1 < corners.size(); ++c) take_cell(std::array{corners[0], corners[c], corners[c + 1]});
    }
  }
}

void Mender::take_cell(std::span<const Index> corners) {
  Cell cell;
  std::copy(corners.begin(), corners.end(), cell.corners.begin());
  bool is_flat = corners.size() < 3;
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) is_flat = is_flat || corners[a] == corners[b];
  if (!is_flat) {
    turn_quad(cell);
    const auto& [a, b, c, d] = cell.corners;
    cell.area = glm::length(normal_of(a, b, c)) + (cell.size() == 4 ? glm::length(normal_of(a, c, d)) : 0.0);
    const double longest = longest_side_of(cell);
    is_flat = !(cell.area > least_height_ratio * longest * longest);
  }
  if (is_flat)
    ++flat_;
  else
    mended_.cells.push_back(cell);
}

// So that the cut leaves both halves facing the same way, and is the shorter one if both do.
void Mender::turn_quad(Cell& cell) const {
  if (cell.size() != 4) return;
  const auto& [a, b, c, d] = cell.corners;
  const bool along_ac = glm::dot(normal_of(a, b, c), normal_of(a, c, d)) > 0.0;
  const bool along_bd = glm::dot(normal_of(a, b, d), normal_of(b, c, d)) > 0.0;
  const bool bd_is_shorter = glm::distance(position(b), position(d)) < glm::distance(position(a), position(c));
  if (along_bd && (!along_ac || bd_is_shorter)) std::rotate(cell.corners.begin(), cell.corners.begin() + 1, cell.corners.end());
}

double Mender::longest_side_of(const Cell& cell) const {
  double longest = 0.0;
  for (int c = 0; c < cell.size(); ++c)
    longest = std::max(longest, glm::distance(position(cell.corners[c]), position(cell.corners[(c + 1) % cell.size()])));
  return longest;
}

// The same corners, whatever the order: the second time it would be twice as stiff and heavy there.
void Mender::drop_repeated_cells() {
  struct Key {
    std::array<Index, 4> corners;
    std::size_t cell;
    bool operator<(const Key& other) const { return std::tie(corners, cell) < std::tie(other.corners, other.cell); }
  };
  std::vector<Key> keys;
  keys.reserve(mended_.cells.size());
  for (std::size_t i = 0; i < mended_.cells.size(); ++i) {
    keys.push_back({mended_.cells[i].corners, i});
    std::sort(keys.back().corners.begin(), keys.back().corners.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> is_repeated(mended_.cells.size(), false);
  for (std::size_t k = 1; k < keys.size(); ++k) is_repeated[keys[k].cell] = keys[k].corners == keys[k - 1].corners;

  std::size_t kept = 0;
  for (std::size_t i = 0; i < mended_.cells.size(); ++i)
    if (!is_repeated[i]) mended_.cells[kept++] = mended_.cells[i];
  repeated_ = mended_.cells.size() - kept;
  mended_.cells.resize(kept);
}

// Vertices that a face needs become points, in the file's order.
void Mender::number_points() {
  if (mended_.cells.empty()) refuse("faces: none with an area: there must be at least one");
  std::vector<Index> point_of(mesh_.vertices.size(), no_index);
  for (const Cell& cell : mended_.cells)
    for (int c = 0; c < cell.size(); ++c) point_of[static_cast<std::size_t>(cell.corners[c])] = 0;
  for (std::size_t vertex = 0; vertex < point_of.size(); ++vertex) {
    if (point_of[vertex] == no_index) continue;
    point_of[vertex] = static_cast<Index>(mended_.points.size());
    mended_.points.push_back(mesh_.vertices[vertex]);
  }
  for (Cell& cell : mended_.cells)
    for (int c = 0; c < cell.size(); ++c) cell.corners[c] = point_of[static_cast<std::size_t>(cell.corners[c])];
}

void Mender::note_all() {
  const auto note = [&](std::size_t count, const char* one, const char* many, const char* what) {
    if (count > 0) notes_.push_back(file_ + ": " + count_of(count, one, many) + what);
  };
  const std::size_t idle = mesh_.vertices.size() - welded_ - mended_.points.size();
  note(welded_, "vertex stands", "vertices stand", " where another one does: welded");
  note(flat_, "face has", "faces have", " no area: left out");
  note(repeated_, "face is", "faces are", " there already: left out");
  note(cut_, "face has", "faces have", " more than four corners: cut into triangles from the first corner");
  note(idle, "vertex belongs", "vertices belong", " to no face: left out");
}

}  // namespace

double MendedMesh::size() const { return glm::distance(least, most); }

MendedMesh mend_mesh(const Mesh& mesh, const std::string& file, std::vector<std::string>& notes) {
  return Mender(mesh, file, notes).mend();
}

}  // namespace hooke
