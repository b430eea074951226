#include "formats/mesh/triangulate.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

// Cuts off ears: corners whose triangle with their neighbors contains no other corner. Every simple polygon has two (Meisters, "Polygons
// have ears", 1975); the algorithm with bridged holes is that of Eberly, "Triangulation by ear clipping", 2002. Departures: the ear with
// the shortest cut is next, for the shape of the triangles; corners on a straight line are no ears, but keep other corners from being ears,
// so that no triangle is without area.
class EarClipper {
 public:
  explicit EarClipper(std::span<const Vec3> polygon) {
    project(polygon);
    remove_spikes();
  }

  bool clip(std::vector<std::array<Index, 3>>& triangles) {
    find_ears();
    double outline = 0.0, covered = 0.0;  // [m^2], twice the areas
    for (std::size_t i = 0; i < ring_.size(); ++i) outline += turn(ring_[0], ring_[i], after(i));
    while (ring_.size() >= 3) {
      const std::size_t tip = next_ear(), count = ring_.size();
      covered += std::abs(turn(before(tip), ring_[tip], after(tip)));
      triangles.push_back({before(tip).index, ring_[tip].index, after(tip).index});
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(tip));
      if (ring_.size() < 3) break;
      for (const std::size_t neighbor : {(tip + count - 2) % ring_.size(), tip % ring_.size()}) update(neighbor);
    }
    return is_simple_ && covered - outline <= static_cast<double>(triangles.size()) * tolerance_;
  }

 private:
  struct Corner {
    Index index;  // in the polygon
    double x, y;  // in the plane of the polygon, which is passed counterclockwise
    bool is_ear = false;
    double cut = 0.0;  // square of the length of the edge that cuts it off
    bool is_at(const Corner& other) const { return x == other.x && y == other.y; }
  };

  // Drops the coordinate along which the polygon is seen largest: the others stay exact.
  void project(std::span<const Vec3> polygon) {
    Vec3 normal(0.0), size(0.0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      normal += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
      size = glm::max(size, glm::abs(polygon[i] - polygon[0]));
    }
    const Vec3 extent = glm::abs(normal);
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    int first = (axis + 1) % 3, second = (axis + 2) % 3;
    if (normal[axis] < 0.0) std::swap(first, second);
    for (std::size_t i = 0; i < polygon.size(); ++i)
      ring_.push_back({static_cast<Index>(i), polygon[i][first] - polygon[0][first], polygon[i][second] - polygon[0][second]});
    constexpr double relative_rounding = 1e-13;  // of twice the area of a triangle, relative to the square of the size of the polygon
    tolerance_ = relative_rounding * glm::dot(size, size);
  }

  // A corner between two corners at the same position has no area.
  void remove_spikes() {
    for (std::size_t i = 0; i < ring_.size() && ring_.size() > 3;) {
      if (!before(i).is_at(after(i)) && !ring_[i].is_at(after(i))) {
        ++i;
        continue;
      }
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(i));
      i = i < 2 ? 0 : i - 2;
    }
  }

  const Corner& before(std::size_t i) const { return ring_[(i + ring_.size() - 1) % ring_.size()]; }
  const Corner& after(std::size_t i) const { return ring_[(i + 1) % ring_.size()]; }

  // Twice the area of a triangle, > 0 if it is passed counterclockwise.
  static double turn(const Corner& a, const Corner& b, const Corner& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

  bool is_ear(std::size_t tip) const {
    const Corner &a = before(tip), &b = ring_[tip], &c = after(tip);
    if (turn(a, b, c) <= tolerance_) return false;
    // another edge from the position of the tip, of a bridge, leads between its two edges
    const auto enters = [&](const Corner& q) { return turn(a, b, q) > tolerance_ && turn(b, c, q) > tolerance_; };
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const Corner& p = ring_[i];
      if (&p == &b || p.is_at(a) || p.is_at(c)) continue;
      if (p.is_at(b)) {
        if (enters(before(i)) || enters(after(i))) return false;
      } else if (turn(a, b, p) >= -tolerance_ && turn(b, c, p) >= -tolerance_ && turn(c, a, p) >= -tolerance_) {
        return false;
      }
    }
    return true;
  }

  void update(std::size_t i) {
    const Corner &a = before(i), &c = after(i);
    ring_[i].cut = (c.x - a.x) * (c.x - a.x) + (c.y - a.y) * (c.y - a.y);
    if (is_simple_) ring_[i].is_ear = is_ear(i);
  }

  void find_ears() {
    for (std::size_t i = 0; i < ring_.size(); ++i) update(i);
  }

  // A polygon without an ear crosses itself: every corner counts as one.
  std::size_t next_ear() {
    std::size_t best = shortest_cut();
    if (best == ring_.size() && is_simple_) {
      is_simple_ = ring_.size() == 3;
      for (Corner& corner : ring_) corner.is_ear = true;
      best = shortest_cut();
    }
    return best;
  }

  std::size_t shortest_cut() const {
    std::size_t best = ring_.size();
    for (std::size_t i = 0; i < ring_.size(); ++i)
      if (ring_[i].is_ear && (best == ring_.size() || ring_[i].cut < ring_[best].cut)) best = i;
    return best;
  }

  std::vector<Corner> ring_;
  double tolerance_ = 0.0;  // [m^2]
  bool is_simple_ = true;
};

}  // namespace

bool triangulate(std::span<const Vec3> polygon, std::vector<std::array<Index, 3>>& triangles) {
  return EarClipper(polygon).clip(triangles);
}

}  // namespace hooke
