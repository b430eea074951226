// Counts what passes through what, in extended precision. It shares no code with src/sim/contact, which it judges.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "support/test_sim.h"

namespace hooke {

namespace exact {

using Real = long double;
using Vector = std::array<Real, 3>;
inline Vector minus(const Vec3& a, const Vec3& b) { return {Real(a.x) - b.x, Real(a.y) - b.y, Real(a.z) - b.z}; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector between(const Vector& a, const Vector& b, Real t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

}  // namespace exact

// Edges of faces that pass through faces: all pairs whose boxes overlap, by the Moeller-Trumbore test.
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
    // edges by their lower end along the first axis, so that most of those out of reach of a face are skipped
    auto edges = edges_;
    const auto low = [&](const std::array<Index, 2>& edge) { return std::min(x[edge[0]].x, x[edge[1]].x); };
    std::ranges::sort(edges, {}, low);
    double longest = 0.0;
    for (const auto& [p, q] : edges) longest = std::max(longest, std::abs(x[p].x - x[q].x));

    long count = 0;
    for (const auto& face : faces_) {
      Vec3 min = x[face[0]], max = x[face[0]];
      for (const Index i : face)
        for (int c = 0; c < 3; ++c) min[c] = std::min(min[c], x[i][c]), max[c] = std::max(max[c], x[i][c]);
      const auto first = std::ranges::lower_bound(edges, min.x - 1.001 * longest, {}, low);
      const auto last = std::ranges::upper_bound(edges, max.x, {}, low);
      for (auto edge = first; edge != last; ++edge) {
        const auto& [p, q] = *edge;
        bool is_apart = false;
        for (int c = 0; c < 3; ++c) is_apart = is_apart || std::max(x[p][c], x[q][c]) < min[c] || std::min(x[p][c], x[q][c]) > max[c];
        if (is_apart || std::ranges::find(face, p) != face.end() || std::ranges::find(face, q) != face.end()) continue;
        if (crosses(x[p], x[q], x[face[0]], x[face[1]], x[face[2]])) ++count;
      }
    }
    return count;
  }

 private:
  // p + t (q - p) = a + u (b - a) + v (c - a) with 0 < t < 1, u > 0, v > 0, u + v < 1
  static bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
    using namespace exact;
    const Vector along = minus(q, p), first = minus(b, a), second = minus(c, a), from = minus(p, a);
    const Vector normal = cross(along, second), other = cross(from, first);
    const Real determinant = dot(first, normal);
    if (determinant == 0) return false;
    const Real u = dot(from, normal) / determinant, v = dot(along, other) / determinant, t = dot(second, other) / determinant;
    return u > 0 && v > 0 && u + v < 1 && t > 0 && t < 1;
  }

  std::vector<std::array<Index, 3>> faces_;
  std::vector<std::array<Index, 2>> edges_;
};

// Springs that pass through each other while their points move along straight lines: all pairs but those with a common point or joined by
// another spring, which do not touch. Four points are in a plane at the roots of a cubic polynomial in time; there both springs intersect
// or do not.
class PassageCounter {
 public:
  explicit PassageCounter(const System& system) {
    for (const Spring& spring : system.springs()) springs_.push_back({system.index_of(spring.first), system.index_of(spring.second)});
    for (const auto& [i, j] : springs_) joined_.insert({{i, j}, {j, i}});
  }

  long count(const std::vector<Vec3>& from, const std::vector<Vec3>& to) const {
    std::vector<std::array<Vec3, 2>> boxes;
    for (const auto& [i, j] : springs_) {
      std::array<Vec3, 2> box{from[i], from[i]};
      for (const Vec3& x : {from[j], to[i], to[j]})
        for (int c = 0; c < 3; ++c) box[0][c] = std::min(box[0][c], x[c]), box[1][c] = std::max(box[1][c], x[c]);
      boxes.push_back(box);
    }
    long count = 0;
    for (std::size_t a = 0; a < springs_.size(); ++a)
      for (std::size_t b = a + 1; b < springs_.size(); ++b) {
        bool is_apart = false;
        for (int c = 0; c < 3; ++c) is_apart = is_apart || boxes[a][1][c] < boxes[b][0][c] || boxes[b][1][c] < boxes[a][0][c];
        const auto& [p, q] = springs_[a];
        const auto& [r, s] = springs_[b];
        if (is_apart || p == r || p == s || q == r || q == s) continue;
        if (joined_.contains({p, r}) || joined_.contains({p, s}) || joined_.contains({q, r}) || joined_.contains({q, s})) continue;
        if (Pair(from, to, p, q, r, s).meets()) ++count;
      }
    return count;
  }

 private:
  // Relative to the first point, so that large coordinates cancel.
  struct Pair {
    using Real = exact::Real;
    std::array<exact::Vector, 3> start, end;  // of the second point and the points of the other spring
    Pair(const std::vector<Vec3>& from, const std::vector<Vec3>& to, Index p, Index q, Index r, Index s)
        : start{exact::minus(from[q], from[p]), exact::minus(from[r], from[p]), exact::minus(from[s], from[p])},
          end{exact::minus(to[q], to[p]), exact::minus(to[r], to[p]), exact::minus(to[s], to[p])} {}

    exact::Vector at(int k, Real t) const { return exact::between(start[k], end[k], t); }
    Real volume(Real t) const { return exact::dot(exact::cross(at(0, t), at(1, t)), at(2, t)); }

    // Where both lines have the same point: u q = r + v (s - r)
    bool intersects(Real t) const {
      const exact::Vector q = at(0, t), r = at(1, t), s = at(2, t), along{s[0] - r[0], s[1] - r[1], s[2] - r[2]};
      const exact::Vector normal = exact::cross(q, along);
      const Real square = exact::dot(normal, normal);
      if (square == 0) return false;
      const Real u = exact::dot(exact::cross(r, along), normal) / square, v = exact::dot(exact::cross(r, q), normal) / square;
      return u > 0 && u < 1 && v > 0 && v < 1;
    }

    bool meets() const {
      // the extrema of the cubic polynomial divide [0, 1] into parts with at most one root each
      const Real f0 = volume(0), f1 = volume(1), fm = volume(-1), f2 = volume(2);
      const Real c3 = (f2 - 3 * f1 + 3 * f0 - fm) / 6, c2 = (f1 - 2 * f0 + fm) / 2, c1 = (f1 - fm) / 2 - c3;
      std::vector<Real> ends{0};
      const Real discriminant = c2 * c2 - 3 * c3 * c1;
      if (discriminant > 0) {
        const Real root = c2 + (c2 < 0 ? -1 : 1) * std::sqrt(discriminant);
        for (const Real t : {c3 != 0 ? -root / (3 * c3) : Real(-1), root != 0 ? -c1 / root : Real(-1)})
          if (t > 0 && t < 1) ends.push_back(t);
      }
      std::sort(ends.begin(), ends.end());
      ends.push_back(1);
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        Real low = ends[i], high = ends[i + 1];
        const bool rises = volume(low) < 0;
        if ((volume(high) < 0) == rises) continue;
        for (int step = 0; step < 70; ++step) {
          const Real middle = (low + high) / 2;
          ((volume(middle) < 0) == rises ? low : high) = middle;
        }
        if (intersects(low)) return true;
      }
      return false;
    }
  };

  std::vector<std::array<Index, 2>> springs_;
  std::set<std::array<Index, 2>> joined_;
};

}  // namespace hooke
