#include "sim/contact/closest.h"

#include "sim/contact/constants.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

void finish(const FourPoints& x, Closest& closest) {
  const std::array<double, 4>& w = closest.weight;
  closest.separation = w[0] * x[0] + w[1] * x[1] + w[2] * x[2] + w[3] * x[3];
  closest.distance = std::sqrt(glm::dot(closest.separation, closest.separation));
}

// Weights of the two ends of an edge, of its point closest to p.
std::array<double, 2> closest_on_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double square = glm::dot(ab, ab), t = square > 0.0 ? std::clamp(glm::dot(p - a, ab) / square, 0.0, 1.0) : 0.0;
  return {1.0 - t, t};
}

Closest closest_on_border(const FourPoints& x) {
  Closest best;
  for (int c = 0; c < 3; ++c) {
    const int a = 1 + c, b = 1 + (c + 1) % 3;
    const auto [at_a, at_b] = closest_on_edge(x[0], x[a], x[b]);
    Closest closest;
    closest.weight[0] = 1.0;
    closest.weight[a] = -at_a;
    closest.weight[b] = -at_b;
    finish(x, closest);
    if (c == 0 || closest.distance < best.distance) best = closest;
  }
  return best;
}

Closest closest_point_face(const FourPoints& x) {
  const Vec3 ab = x[2] - x[1], ac = x[3] - x[1], ap = x[0] - x[1];
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  const double bb = glm::dot(ab, ab), bc = glm::dot(ab, ac), cc = glm::dot(ac, ac);
  const double denominator = bb * cc - bc * bc;
  const double v = cc * d1 - bc * d2, w = bb * d2 - bc * d1;
  if (!(v > 0.0 && w > 0.0 && v + w < denominator)) return closest_on_border(x);
  const double b1 = v / denominator, b2 = w / denominator;
  Closest closest{.weight = {1.0, -(1.0 - b1 - b2), -b1, -b2}};
  finish(x, closest);
  return closest;
}

Closest closest_edges(const FourPoints& x) {
  const Vec3 first = x[1] - x[0], second = x[3] - x[2], r = x[0] - x[2];
  const double a = glm::dot(first, first), b = glm::dot(first, second), e = glm::dot(second, second);
  const double c = glm::dot(first, r), f = glm::dot(second, r), denominator = a * e - b * b;
  double s = denominator > 0.0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  double t = e > 0.0 ? (b * s + f) / e : 0.0;
  if (t < 0.0 || t > 1.0) {
    t = std::clamp(t, 0.0, 1.0);
    s = a > 0.0 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0.0;
  }
  Closest closest{.weight = {1.0 - s, s, -(1.0 - t), -t}, .is_at_end = s <= 0.0 || s >= 1.0 || t <= 0.0 || t >= 1.0};
  finish(x, closest);
  return closest;
}

}  // namespace

Closest closest_points(FeaturePair kind, const FourPoints& x) {
  return kind == FeaturePair::PointFace ? closest_point_face(x) : closest_edges(x);
}

double free_part(FeaturePair kind, const FourPoints& x, const FourPoints& displacement, double distance, long& steps) {
  const Vec3 mean = 0.25 * (displacement[0] + displacement[1] + displacement[2] + displacement[3]);
  FourPoints relative;
  std::array<double, 4> length{};
  for (int i = 0; i < 4; ++i) {
    relative[i] = displacement[i] - mean;
    length[i] = std::sqrt(glm::dot(relative[i], relative[i]));
  }
  // by how much the distance changes at most
  const double reach = kind == FeaturePair::PointFace ? length[0] + std::max({length[1], length[2], length[3]})
                                                      : std::max(length[0], length[1]) + std::max(length[2], length[3]);
  using contact::ccd_min_part, contact::ccd_safety;
  double t = 0.0, now = distance;
  constexpr int max_steps = 1000;
  for (int step = 0; step < max_steps; ++step) {
    const double next = t + ccd_safety * now / reach;
    if (!(next < 1.0)) return 1.0;
    ++steps;
    FourPoints at;
    for (int i = 0; i < 4; ++i) at[i] = x[i] + next * relative[i];
    const double then = closest_points(kind, at).distance;
    if (!(then > ccd_min_part * distance)) return t;
    t = next;
    now = then;
  }
  return t;
}

}  // namespace hooke
