// The operations of closest.cpp on many pairs at once. Compiled once for each vector unit by Highway, which picks one at run time; the same
// IEEE operations in every width.
#include "sim/contact/closest_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/closest_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using V = hn::Vec<Lanes>;

struct V3 {
  V x, y, z;
};

HWY_INLINE V3 minus(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE V dot(const V3& a, const V3& b) { return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z)); }
HWY_INLINE V from_0_to_1(V value) {
  const Lanes d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  return hn::IfThenElse(hn::Lt(value, zero), zero, hn::IfThenElse(hn::Lt(one, value), one, value));
}

struct ClosestLanes {
  V weight[4];
  V3 separation;
  V distance, is_at_end;
};

HWY_INLINE V weighted(const V* weight, V x0, V x1, V x2, V x3) {
  return hn::Add(hn::Add(hn::Add(hn::Mul(weight[0], x0), hn::Mul(weight[1], x1)), hn::Mul(weight[2], x2)), hn::Mul(weight[3], x3));
}

HWY_INLINE void finish(const V3* x, ClosestLanes& closest) {
  const V* w = closest.weight;
  closest.separation = {weighted(w, x[0].x, x[1].x, x[2].x, x[3].x), weighted(w, x[0].y, x[1].y, x[2].y, x[3].y),
                        weighted(w, x[0].z, x[1].z, x[2].z, x[3].z)};
  closest.distance = hn::Sqrt(dot(closest.separation, closest.separation));
}

template <class M>
HWY_INLINE void select(M is_second, const ClosestLanes& second, ClosestLanes& closest) {
  for (int c = 0; c < 4; ++c) closest.weight[c] = hn::IfThenElse(is_second, second.weight[c], closest.weight[c]);
  closest.separation.x = hn::IfThenElse(is_second, second.separation.x, closest.separation.x);
  closest.separation.y = hn::IfThenElse(is_second, second.separation.y, closest.separation.y);
  closest.separation.z = hn::IfThenElse(is_second, second.separation.z, closest.separation.z);
  closest.distance = hn::IfThenElse(is_second, second.distance, closest.distance);
}

template <int A, int B>
HWY_INLINE ClosestLanes closest_on_side(const V3* x) {
  const Lanes d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V3 side = minus(x[B], x[A]);
  const V square = dot(side, side);
  const V t = hn::IfThenElseZero(hn::Gt(square, zero), from_0_to_1(hn::Div(dot(minus(x[0], x[A]), side), square)));
  ClosestLanes closest{{one, zero, zero, zero}, {}, {}, zero};
  closest.weight[A] = hn::Neg(hn::Sub(one, t));
  closest.weight[B] = hn::Neg(t);
  finish(x, closest);
  return closest;
}

HWY_INLINE ClosestLanes closest_point_face(const V3* x) {
  const Lanes d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V3 ab = minus(x[2], x[1]), ac = minus(x[3], x[1]), ap = minus(x[0], x[1]);
  const V d1 = dot(ab, ap), d2 = dot(ac, ap), bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  const V denominator = hn::Sub(hn::Mul(bb, cc), hn::Mul(bc, bc));
  const V v = hn::Sub(hn::Mul(cc, d1), hn::Mul(bc, d2)), w = hn::Sub(hn::Mul(bb, d2), hn::Mul(bc, d1));
  const auto is_inside = hn::And(hn::And(hn::Gt(v, zero), hn::Gt(w, zero)), hn::Lt(hn::Add(v, w), denominator));
  const V b1 = hn::Div(v, denominator), b2 = hn::Div(w, denominator);
  ClosestLanes inside{{one, hn::Neg(hn::Sub(hn::Sub(one, b1), b2)), hn::Neg(b1), hn::Neg(b2)}, {}, {}, zero};
  finish(x, inside);
  if (hn::AllTrue(d, is_inside)) return inside;

  ClosestLanes closest = closest_on_side<1, 2>(x);
  const ClosestLanes second = closest_on_side<2, 3>(x), third = closest_on_side<3, 1>(x);
  select(hn::Lt(second.distance, closest.distance), second, closest);
  select(hn::Lt(third.distance, closest.distance), third, closest);
  select(is_inside, inside, closest);
  return closest;
}

HWY_INLINE ClosestLanes closest_edges(const V3* x) {
  const Lanes lanes;
  const V zero = hn::Zero(lanes), one = hn::Set(lanes, 1.0);
  const V3 first = minus(x[1], x[0]), second = minus(x[3], x[2]), r = minus(x[0], x[2]);
  const V a = dot(first, first), b = dot(first, second), e = dot(second, second), c = dot(first, r), f = dot(second, r);
  const V denominator = hn::Sub(hn::Mul(a, e), hn::Mul(b, b));
  V s = hn::IfThenElseZero(hn::Gt(denominator, zero), from_0_to_1(hn::Div(hn::Sub(hn::Mul(b, f), hn::Mul(c, e)), denominator)));
  V t = hn::IfThenElseZero(hn::Gt(e, zero), hn::Div(hn::Add(hn::Mul(b, s), f), e));
  const auto is_beyond = hn::Or(hn::Lt(t, zero), hn::Gt(t, one));
  const V end = from_0_to_1(t);
  s = hn::IfThenElse(is_beyond, hn::IfThenElseZero(hn::Gt(a, zero), from_0_to_1(hn::Div(hn::Sub(hn::Mul(b, end), c), a))), s);
  t = hn::IfThenElse(is_beyond, end, t);
  const auto is_at_end = hn::Or(hn::Or(hn::Le(s, zero), hn::Ge(s, one)), hn::Or(hn::Le(t, zero), hn::Ge(t, one)));
  ClosestLanes closest{{hn::Sub(one, s), s, hn::Neg(hn::Sub(one, t)), hn::Neg(t)}, {}, {}, hn::IfThenElseZero(is_at_end, one)};
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
  HWY_INLINE V3 at(int i, int p) const {
    V3 at;
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
    const V3 x[4] = {gathered.at(0, p), gathered.at(1, p), gathered.at(2, p), gathered.at(3, p)};
    const ClosestLanes closest = kind == FeaturePair::PointFace ? closest_point_face(x) : closest_edges(x);
    for (int c = 0; c < 4; ++c) hn::Store(closest.weight[c], d, block.weight[c] + p);
    hn::Store(closest.separation.x, d, block.separation[0] + p);
    hn::Store(closest.separation.y, d, block.separation[1] + p);
    hn::Store(closest.separation.z, d, block.separation[2] + p);
    hn::Store(closest.distance, d, block.distance + p);
    hn::Store(closest.is_at_end, d, block.is_at_end + p);
  }
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

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
