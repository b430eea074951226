#include "sim/contact/supports.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {

Vec3 tangential(const Vec3& normal, const Vec3& w) { return w - glm::dot(w, normal) * normal; }

// Tried in turn: no support is loaded, one, two. If two are not enough, nothing moves.
Vec3 constrain(std::span<Support> supports, const Vec3& a, const Vec3& v) {
  const auto separation = [&](const Support& s, const Vec3& w) {
    return glm::dot(s.normal, w - s.obstacle->acceleration) + s.centripetal(v - s.velocity);
  };
  const auto is_feasible = [&](const Vec3& w) {
    return std::ranges::all_of(supports, [&](const Support& s) { return separation(s, w) >= -1e-12 * glm::length(a); });
  };

  for (Support& s : supports) s.normal_acceleration = 0.0;
  if (is_feasible(a)) return a;

  for (Support& s : supports) {
    const double n = -separation(s, a);
    if (n <= 0.0 || !is_feasible(a + n * s.normal)) continue;
    s.normal_acceleration = n;
    return a + n * s.normal;
  }

  for (Support& first : supports)
    for (Support& second : supports) {
      const double cosine = glm::dot(first.normal, second.normal), determinant = 1.0 - cosine * cosine;
      if (&first >= &second || determinant < 1e-12) continue;
      const double b1 = -separation(first, a), b2 = -separation(second, a);
      const double n1 = (b1 - cosine * b2) / determinant, n2 = (b2 - cosine * b1) / determinant;
      const Vec3 constrained = a + n1 * first.normal + n2 * second.normal;
      if (n1 < 0.0 || n2 < 0.0 || !is_feasible(constrained)) continue;
      first.normal_acceleration = n1;
      second.normal_acceleration = n2;
      return constrained;
    }

  for (Support& s : supports) s.normal_acceleration = std::max(0.0, -separation(s, a));
  return Vec3(0.0);
}

Support combine_supports(const Supports& supports) {
  Support combined;
  double weight = 0.0;
  Vec3 surface(0.0), surface_acceleration(0.0);
  bool identical = true;
  for (const Support& s : supports.all()) {
    if (!(s.normal_acceleration > 0.0)) continue;
    identical = identical && (combined.obstacle == nullptr ||
                              (s.surface == combined.surface && s.surface_acceleration == combined.surface_acceleration));
    if (combined.obstacle == nullptr || s.curvature > 0.0) combined = s;
    weight += s.friction() * s.normal_acceleration;
    surface += s.friction() * s.normal_acceleration * s.surface;
    surface_acceleration += s.friction() * s.normal_acceleration * s.surface_acceleration;
  }
  if (identical || weight == 0.0) return combined;
  combined.surface = surface / weight;
  combined.surface_acceleration = surface_acceleration / weight;
  return combined;
}

}  // namespace hooke
