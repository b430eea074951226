// Counts edges of faces that pass through faces: all pairs, by the Moeller-Trumbore test in extended precision. It shares no code with
// src/sim/contact, which it judges.
#pragma once

#include <algorithm>
#include <array>
#include <set>

#include "support/test_sim.h"

namespace hooke {

class CrossingCounter {
 public:
  explicit CrossingCounter(const System& system) {
    std::set<std::array<Index, 2>> edges;
    for (const Face& face : system.faces) {
      std::array<Index, 3> corner{};
      for (int c = 0; c < 3; ++c) corner[c] = system.index_of(face.points[c]);
      faces_.push_back(corner);
      for (int c = 0; c < 3; ++c) edges.insert({std::min(corner[c], corner[(c + 1) % 3]), std::max(corner[c], corner[(c + 1) % 3])});
    }
    edges_.assign(edges.begin(), edges.end());
  }

  long count(const std::vector<Vec3>& x) const {
    long count = 0;
    for (const auto& face : faces_) {
      Vec3 min = x[face[0]], max = x[face[0]];
      for (const Index i : face)
        for (int c = 0; c < 3; ++c) min[c] = std::min(min[c], x[i][c]), max[c] = std::max(max[c], x[i][c]);
      for (const auto& [p, q] : edges_) {
        bool is_apart = false;
        for (int c = 0; c < 3; ++c) is_apart = is_apart || std::max(x[p][c], x[q][c]) < min[c] || std::min(x[p][c], x[q][c]) > max[c];
        if (is_apart || std::ranges::find(face, p) != face.end() || std::ranges::find(face, q) != face.end()) continue;
        if (crosses(x[p], x[q], x[face[0]], x[face[1]], x[face[2]])) ++count;
      }
    }
    return count;
  }

 private:
  using Real = long double;
  using Exact = std::array<Real, 3>;
  static Exact minus(const Vec3& a, const Vec3& b) { return {Real(a.x) - b.x, Real(a.y) - b.y, Real(a.z) - b.z}; }
  static Exact cross(const Exact& a, const Exact& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Real dot(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  // p + t (q - p) = a + u (b - a) + v (c - a) with 0 < t < 1, u > 0, v > 0, u + v < 1
  static bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Exact along = minus(q, p), first = minus(b, a), second = minus(c, a), from = minus(p, a);
    const Exact normal = cross(along, second), other = cross(from, first);
    const Real determinant = dot(first, normal);
    if (determinant == 0) return false;
    const Real u = dot(from, normal) / determinant, v = dot(along, other) / determinant, t = dot(second, other) / determinant;
    return u > 0 && v > 0 && u + v < 1 && t > 0 && t < 1;
  }

  std::vector<std::array<Index, 3>> faces_;
  std::vector<std::array<Index, 2>> edges_;
};

}  // namespace hooke
