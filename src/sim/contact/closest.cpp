// The closest points of two features, as a template over a number and a vector of numbers. Compiled once for each vector unit by Highway,
// which picks one at run time; the same IEEE operations in every width.
#include "sim/contact/closest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/closest_kernel.h"
#include "sim/contact/constants.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/closest.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using V = hn::Vec<Lanes>;
using M = hn::Mask<Lanes>;

template <class T>
HWY_INLINE T number(double value) {
  if constexpr (std::is_same_v<T, double>)
    return value;
  else
    return hn::Set(Lanes(), value);
}
HWY_INLINE bool is_less(double a, double b) { return a < b; }
HWY_INLINE M is_less(V a, V b) { return hn::Lt(a, b); }
HWY_INLINE bool both(bool a, bool b) { return a && b; }
HWY_INLINE M both(M a, M b) { return hn::And(a, b); }
HWY_INLINE bool either(bool a, bool b) { return a || b; }
HWY_INLINE M either(M a, M b) { return hn::Or(a, b); }
HWY_INLINE bool is_all(bool a) { return a; }
HWY_INLINE bool is_all(M a) { return hn::AllTrue(Lanes(), a); }
HWY_INLINE double choose(bool is_first, double first, double second) { return is_first ? first : second; }
HWY_INLINE V choose(M is_first, V first, V second) { return hn::IfThenElse(is_first, first, second); }
HWY_INLINE double root(double a) { return std::sqrt(a); }
HWY_INLINE V root(V a) { return hn::Sqrt(a); }
HWY_INLINE bool none(double) { return false; }
HWY_INLINE M none(V a) { return hn::Lt(a, a); }

template <class T>
struct V3 {
  T x, y, z;
};
template <class T>
HWY_INLINE V3<T> minus(const V3<T>& a, const V3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
HWY_INLINE T dot(const V3<T>& a, const V3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
HWY_INLINE T from_0_to_1(T value) {
  const T zero = number<T>(0.0), one = number<T>(1.0);
  return choose(is_less(value, zero), zero, choose(is_less(one, value), one, value));
}

template <class T>
struct ClosestOf {
  T weight[4];
  V3<T> separation;
  T distance;
  decltype(is_less(T(), T())) is_at_end;
};

template <class T>
HWY_INLINE void finish(const V3<T>* x, ClosestOf<T>& closest) {
  const T* w = closest.weight;
  closest.separation = {w[0] * x[0].x + w[1] * x[1].x + w[2] * x[2].x + w[3] * x[3].x,
                        w[0] * x[0].y + w[1] * x[1].y + w[2] * x[2].y + w[3] * x[3].y,
                        w[0] * x[0].z + w[1] * x[1].z + w[2] * x[2].z + w[3] * x[3].z};
  closest.distance = root(dot(closest.separation, closest.separation));
}

template <class Mask, class T>
HWY_INLINE void select(Mask is_second, const ClosestOf<T>& second, ClosestOf<T>& closest) {
  for (int c = 0; c < 4; ++c) closest.weight[c] = choose(is_second, second.weight[c], closest.weight[c]);
  closest.separation = {choose(is_second, second.separation.x, closest.separation.x),
                        choose(is_second, second.separation.y, closest.separation.y),
                        choose(is_second, second.separation.z, closest.separation.z)};
  closest.distance = choose(is_second, second.distance, closest.distance);
}

// Of the point 0 and the side from A to B.
template <int A, int B, class T>
HWY_INLINE ClosestOf<T> closest_on_side(const V3<T>* x) {
  const T zero = number<T>(0.0), one = number<T>(1.0);
  const V3<T> side = minus(x[B], x[A]);
  const T square = dot(side, side);
  const T t = choose(is_less(zero, square), from_0_to_1(dot(minus(x[0], x[A]), side) / square), zero);
  ClosestOf<T> closest{{one, zero, zero, zero}, {}, zero, none(zero)};
  closest.weight[A] = zero - (one - t);
  closest.weight[B] = zero - t;
  finish(x, closest);
  return closest;
}

template <class T>
HWY_INLINE ClosestOf<T> closest_point_face(const V3<T>* x) {
  const T zero = number<T>(0.0), one = number<T>(1.0);
  const V3<T> ab = minus(x[2], x[1]), ac = minus(x[3], x[1]), ap = minus(x[0], x[1]);
  const T d1 = dot(ab, ap), d2 = dot(ac, ap), bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  const T denominator = bb * cc - bc * bc, v = cc * d1 - bc * d2, w = bb * d2 - bc * d1;
  const auto is_inside = both(both(is_less(zero, v), is_less(zero, w)), is_less(v + w, denominator));
  const T b1 = v / denominator, b2 = w / denominator;
  ClosestOf<T> inside{{one, zero - (one - b1 - b2), zero - b1, zero - b2}, {}, zero, none(zero)};
  finish(x, inside);
  if (is_all(is_inside)) return inside;

  ClosestOf<T> closest = closest_on_side<1, 2>(x);
  const ClosestOf<T> second = closest_on_side<2, 3>(x), third = closest_on_side<3, 1>(x);
  select(is_less(second.distance, closest.distance), second, closest);
  select(is_less(third.distance, closest.distance), third, closest);
  select(is_inside, inside, closest);
  return closest;
}

template <class T>
HWY_INLINE ClosestOf<T> closest_edges(const V3<T>* x) {
  const T zero = number<T>(0.0), one = number<T>(1.0);
  const V3<T> first = minus(x[1], x[0]), second = minus(x[3], x[2]), r = minus(x[0], x[2]);
  const T a = dot(first, first), b = dot(first, second), e = dot(second, second), c = dot(first, r), f = dot(second, r);
  const T denominator = a * e - b * b;
  T s = choose(is_less(zero, denominator), from_0_to_1((b * f - c * e) / denominator), zero);
  T t = choose(is_less(zero, e), (b * s + f) / e, zero);
  const auto is_beyond = either(is_less(t, zero), is_less(one, t));
  const T end = from_0_to_1(t);
  s = choose(is_beyond, choose(is_less(zero, a), from_0_to_1((b * end - c) / a), zero), s);
  t = choose(is_beyond, end, t);
  const auto is_inside = both(both(is_less(zero, s), is_less(s, one)), both(is_less(zero, t), is_less(t, one)));
  ClosestOf<T> closest{{one - s, s, zero - (one - t), zero - t}, {}, zero, is_less(choose(is_inside, zero, number<T>(-1.0)), zero)};
  finish(x, closest);
  return closest;
}

// The values of a field at the points of all pairs, and of the last one again up to a whole vector.
struct Gathered {
  HWY_ALIGN double value[4][FeatureBlock::capacity][4];  // the last component is unused

  HWY_INLINE void gather(std::span<const Vec3> field, const FeatureBlock& block, int end) {
    for (int p = 0; p < end; ++p) {
      const auto& points = block.points[p < block.count ? p : block.count - 1];
      for (int i = 0; i < 4; ++i) {
        const Vec3& at = field[points[i]];
        value[i][p][0] = at.x;
        value[i][p][1] = at.y;
        value[i][p][2] = at.z;
        value[i][p][3] = 0.0;
      }
    }
  }
  HWY_INLINE V3<V> at(int i, int p) const {
    V3<V> at;
    V unused;
    hn::LoadInterleaved4(Lanes(), value[i][p], at.x, at.y, at.z, unused);
    return at;
  }
};

HWY_INLINE int whole_vectors(int count) {
  const int lanes = static_cast<int>(hn::Lanes(Lanes()));
  return (count + lanes - 1) / lanes * lanes;
}

void closest_of_block(FeaturePair kind, std::span<const Vec3> field, FeatureBlock& block) {
  const Lanes d;
  const int end = whole_vectors(block.count);
  Gathered gathered;
  gathered.gather(field, block, end);
  for (int p = 0; p < end; p += static_cast<int>(hn::Lanes(d))) {
    const V3<V> x[4] = {gathered.at(0, p), gathered.at(1, p), gathered.at(2, p), gathered.at(3, p)};
    const ClosestOf<V> closest = kind == FeaturePair::PointFace ? closest_point_face(x) : closest_edges(x);
    for (int c = 0; c < 4; ++c) hn::Store(closest.weight[c], d, block.weight[c] + p);
    hn::Store(closest.separation.x, d, block.separation[0] + p);
    hn::Store(closest.separation.y, d, block.separation[1] + p);
    hn::Store(closest.separation.z, d, block.separation[2] + p);
    hn::Store(closest.distance, d, block.distance + p);
    hn::Store(choose(closest.is_at_end, number<V>(1.0), number<V>(0.0)), d, block.is_at_end + p);
  }
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

Closest closest_points(FeaturePair kind, const FourPoints& x) {
  using namespace HWY_NAMESPACE;
  using P = V3<double>;
  const P points[4] = {{x[0].x, x[0].y, x[0].z}, {x[1].x, x[1].y, x[1].z}, {x[2].x, x[2].y, x[2].z}, {x[3].x, x[3].y, x[3].z}};
  const ClosestOf<double> closest = kind == FeaturePair::PointFace ? closest_point_face(points) : closest_edges(points);
  return {.weight = {closest.weight[0], closest.weight[1], closest.weight[2], closest.weight[3]},
          .separation = {closest.separation.x, closest.separation.y, closest.separation.z},
          .distance = closest.distance,
          .is_at_end = closest.is_at_end};
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

HWY_EXPORT(closest_of_block);

void find_closest(FeaturePair kind, std::span<const Vec3> x, FeatureBlock& block) {
  if (block.count > 0) HWY_DYNAMIC_DISPATCH(closest_of_block)(kind, x, block);
}

void find_distances(FeaturePair kind, std::span<const Vec3> x, std::span<const std::array<Index, 4>> pairs, std::span<double> distances) {
  FeatureBlock block;
  for (std::size_t from = 0; from < pairs.size(); from += FeatureBlock::capacity) {
    const auto part = pairs.subspan(from, std::min<std::size_t>(FeatureBlock::capacity, pairs.size() - from));
    std::ranges::copy(part, block.points.begin());
    block.count = static_cast<int>(part.size());
    find_closest(kind, x, block);
    std::copy_n(block.distance, part.size(), distances.begin() + static_cast<std::ptrdiff_t>(from));
  }
}

}  // namespace hooke
#endif
