#include "sim/plan/surface_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sim/model/rest_lengths.h"
#include "sim/plan/constants.h"

namespace hooke {
namespace {

// Fills a SurfacePlan from the faces and springs of a System.
class SurfacePlanner {
 public:
  SurfacePlanner(const System& system, SurfacePlan& plan) : system_(system), plan_(plan), rest_(system) {}

  void plan() {
    find_pieces();
    plan_.on = !plan_.pieces.empty();
    if (!plan_.on) return;
    find_own_parts();
    find_thickness();
    find_excluded();
  }

 private:
  Index local(PointId id) const { return local_[system_.index_of(id)]; }
  EdgeEnds ends_of(const Spring& spring) const { return edge_ends(local(spring.first), local(spring.second)); }

  // Springs of a lattice cross each other at rest: only its threads touch.
  bool touches(const Spring& spring) const {
    const bool is_thread = spring.family == SpringFamily::None || spring.family == SpringFamily::Structural;
    if (!is_thread || spring.first == spring.second) return false;
    return !on_face_[system_.index_of(spring.first)] || !on_face_[system_.index_of(spring.second)];
  }

  void find_pieces() {
    const auto n = static_cast<std::size_t>(system_.point_count());
    on_face_.assign(n, 0);
    const bool has_faces = system_.contact.faces && system_.dimensions == 3;
    if (has_faces) mark_faces(on_face_);
    std::vector<char> used = on_face_;
    if (system_.contact.springs)
      for (const Spring& spring : system_.springs())
        if (touches(spring)) mark_ends(spring, used);
    if (std::ranges::find(used, 1) == used.end()) return;
    const std::vector<char> spheres = find_spheres();
    local_.assign(n, no_index);
    for (Index i = 0; i < system_.point_count(); ++i) {
      if (used[i] == 0 && spheres[i] == 0) continue;
      local_[i] = static_cast<Index>(plan_.points.size());
      plan_.points.push_back(i);
    }
    if (has_faces)
      for (const Face& face : system_.faces)
        plan_.pieces.push_back({.points = {local(face.points[0]), local(face.points[1]), local(face.points[2])}});
    if (system_.contact.springs)
      for (const Spring& spring : system_.springs()) {
        const Index i = local(spring.first), j = local(spring.second);
        if (touches(spring)) plan_.pieces.push_back({.points = {i, j, i}, .is_face = false});
      }
    add_spheres(spheres);
  }

  void mark_faces(std::vector<char>& marked) const {
    for (const Face& face : system_.faces)
      for (const PointId id : face.points) marked[system_.index_of(id)] = 1;
  }
  void mark_ends(const Spring& spring, std::vector<char>& marked) const {
    marked[system_.index_of(spring.first)] = marked[system_.index_of(spring.second)] = 1;
  }

  // What hangs on springs that do not touch, such as the inner points of a lattice, is none.
  std::vector<char> find_spheres() const {
    std::vector<char> others(static_cast<std::size_t>(system_.point_count()), 0);
    mark_faces(others);
    for (const Spring& spring : system_.springs()) mark_ends(spring, others);
    for (char& each : others) each = each == 0 ? 1 : 0;
    return others;
  }

  void add_spheres(std::span<const char> spheres) {
    if (std::ranges::find(spheres, 1) == spheres.end()) return;
    plan_.radius.assign(plan_.points.size(), 0.0);
    for (Index k = 0; k < static_cast<Index>(plan_.points.size()); ++k) {
      const Index i = plan_.points[k];
      if (spheres[i] == 0) continue;
      plan_.radius[k] = system_.points()[i].radius;
      plan_.pieces.push_back({.points = {k, k, k}, .is_face = false});
    }
  }

  // Each corner and edge belongs to the first piece that has it.
  void find_own_parts() {
    std::vector<char> has_owner(plan_.points.size(), 0);
    std::set<EdgeEnds> known;
    for (SurfacePiece& piece : plan_.pieces) {
      piece.first_corner = static_cast<Index>(plan_.corners.size());
      piece.first_edge = static_cast<Index>(plan_.edges.size());
      for (unsigned c = 0; c < 3; ++c) {
        const Index i = piece.points[c];
        if (has_owner[i] == 0) {
          plan_.corners.push_back(i);
          piece.owned |= static_cast<unsigned char>(piece.is_face ? 8U << c : 0U);
        }
        has_owner[i] = 1;
        const EdgeEnds side = edge_ends(i, piece.points[(c + 1) % 3]);
        if ((c > 0 && !piece.is_face) || !known.insert(side).second) continue;
        plan_.edges.push_back(side);
        piece.owned |= static_cast<unsigned char>(piece.is_face ? 1U << c : 0U);
      }
      std::sort(plan_.edges.begin() + piece.first_edge, plan_.edges.end());
      plan_.is_spring.resize(plan_.edges.size(), piece.is_face ? 0 : 1);
      piece.end_corner = static_cast<Index>(plan_.corners.size());
      piece.end_edge = static_cast<Index>(plan_.edges.size());
    }
  }

  // [m]; 0: no spring joins them.
  double rest_length(Index i, Index j) const { return rest_.between(plan_.points[i], plan_.points[j]); }

  // The smallest height of a face, or the length of a spring [m]; 0: not known, or flat.
  double height_of(const SurfacePiece& piece) const {
    const double a = rest_length(piece.points[0], piece.points[1]);
    if (!piece.is_face) return a;
    const double b = rest_length(piece.points[1], piece.points[2]), c = rest_length(piece.points[2], piece.points[0]);
    const double s = 0.5 * (a + b + c), square = s * (s - a) * (s - b) * (s - c);
    return a > 0.0 && b > 0.0 && c > 0.0 && square > 0.0 ? 2.0 * std::sqrt(square) / std::max({a, b, c}) : 0.0;
  }

  void find_thickness() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> height(plan_.points.size(), infinity);
    for (const SurfacePiece& piece : plan_.pieces) {
      const double at_rest = height_of(piece);
      if (at_rest > 0.0)
        for (const Index i : piece.points) height[i] = std::min(height[i], at_rest);
    }
    for (const SurfacePiece& piece : plan_.pieces)
      if (piece.is_sphere()) height[piece.points[0]] = 0.0;
    for (const double at_rest : height) {
      if (at_rest == 0.0) {
        plan_.thickness.push_back(infinity);
        continue;
      }
      const double given = system_.contact.thickness;
      plan_.thickness.push_back(at_rest == infinity
                                    ? std::max(given, min_thickness)
                                    : std::clamp(given, min_relative_thickness * at_rest, max_relative_thickness * at_rest));
      plan_.max_thickness = std::max(plan_.max_thickness, plan_.thickness.back());
    }
    double sum = 0.0;
    std::size_t count = 0;
    for (const EdgeEnds& edge : plan_.edges)
      if (const double length = rest_length(edge[0], edge[1]); length > 0.0) {
        sum += length;
        ++count;
      }
    plan_.edge_length = count > 0 ? sum / static_cast<double>(count) : 0.0;
  }

  void find_excluded() {
    for (const Spring& spring : system_.springs()) {
      const EdgeEnds ends = ends_of(spring);
      if (ends[0] == no_index || ends[0] == ends[1]) continue;
      const double thickness = std::min(plan_.thickness[ends[0]], plan_.thickness[ends[1]]);
      if (spring.rest_length <= thickness * (1.0 + 1e-9)) plan_.close.push_back(ends);
      if (system_.contact.springs) plan_.joined.push_back(ends);
    }
    std::ranges::sort(plan_.close);
    std::ranges::sort(plan_.joined);
  }

  const System& system_;
  SurfacePlan& plan_;
  std::vector<Index> local_;  // per point of the System; no_index: not part of it
  std::vector<char> on_face_;
  RestLengths rest_;
};

// Whether any point of one is one of the other, or is in the list with it.
bool are_linked(std::span<const Index> first, std::span<const Index> second, const std::vector<EdgeEnds>& links) {
  for (const Index i : first)
    for (const Index j : second)
      if (i == j || (!links.empty() && std::ranges::binary_search(links, edge_ends(i, j)))) return true;
  return false;
}

}  // namespace

bool SurfacePlan::excludes_face(Index point, std::span<const Index> face) const { return are_linked({&point, 1}, face, close); }

// The closest point of the edge of a face is that of the face. Spheres touch each other only as points do.
bool SurfacePlan::excludes_edge(Index edge, Index other) const {
  if (!radius.empty() && ((is_sphere(edge) && (is_spring[other] == 0 || is_sphere(other))) || (is_sphere(other) && is_spring[edge] == 0)))
    return true;
  return are_linked(edges[edge], edges[other], is_spring[edge] || is_spring[other] ? joined : close);
}

SurfacePlan plan_surface(const System& system) {
  SurfacePlan plan;
  plan.frequency = system.contact.frequency;
  plan.damping_ratio = system.contact.damping_ratio;
  if (!system.contact.faces && !system.contact.springs) return plan;
  plan.friction = system.contact.friction;
  plan.restitution = system.contact.restitution;
  SurfacePlanner(system, plan).plan();
  return plan;
}

}  // namespace hooke
