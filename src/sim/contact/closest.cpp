// Compiled once for each vector unit by Highway, which picks one at run time; the same IEEE operations in every width.
#include "sim/contact/closest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/constants.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/closest.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "sim/forces/lane_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE Lane choose(LaneMask mask, Lane yes, Lane no) { return hn::IfThenElse(mask, yes, no); }
HWY_INLINE Lane from_0_to_1(Lane value) {
  const Lane zero = same(0.0), one = same(1.0);
  return choose(hn::Lt(value, zero), zero, choose(hn::Lt(one, value), one, value));
}

struct ClosestLanes {
  Lane weight[4];
  LaneVec3 separation;
  Lane distance;
  LaneMask is_at_end;
};

HWY_INLINE void finish(const LaneVec3* x, ClosestLanes& closest) {
  const Lane* w = closest.weight;
  closest.separation = plus(plus(plus(times(w[0], x[0]), times(w[1], x[1])), times(w[2], x[2])), times(w[3], x[3]));
  closest.distance = hn::Sqrt(dot(closest.separation, closest.separation));
}

HWY_INLINE void select(LaneMask is_second, const ClosestLanes& second, ClosestLanes& closest) {
  for (int c = 0; c < 4; ++c) closest.weight[c] = choose(is_second, second.weight[c], closest.weight[c]);
  closest.separation = choose(is_second, second.separation, closest.separation);
  closest.distance = choose(is_second, second.distance, closest.distance);
}

// Of the point 0 and the side from A to B.
template <int A, int B>
HWY_INLINE ClosestLanes closest_on_side(const LaneVec3* x) {
  const Lane zero = same(0.0), one = same(1.0);
  const LaneVec3 side = minus(x[B], x[A]);
  const Lane square = dot(side, side);
  const Lane t = choose(hn::Lt(zero, square), from_0_to_1(dot(minus(x[0], x[A]), side) / square), zero);
  ClosestLanes closest{{one, zero, zero, zero}, {}, zero, hn::Lt(zero, zero)};
  closest.weight[A] = zero - (one - t);
  closest.weight[B] = zero - t;
  finish(x, closest);
  return closest;
}

HWY_INLINE ClosestLanes closest_point_face(const LaneVec3* x) {
  const Lane zero = same(0.0), one = same(1.0);
  const LaneVec3 ab = minus(x[2], x[1]), ac = minus(x[3], x[1]), ap = minus(x[0], x[1]);
  const Lane d1 = dot(ab, ap), d2 = dot(ac, ap), bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  const Lane denominator = bb * cc - bc * bc, v = cc * d1 - bc * d2, w = bb * d2 - bc * d1;
  const auto is_inside = hn::And(hn::And(hn::Lt(zero, v), hn::Lt(zero, w)), hn::Lt(v + w, denominator));
  const Lane b1 = v / denominator, b2 = w / denominator;
  ClosestLanes inside{{one, zero - (one - b1 - b2), zero - b1, zero - b2}, {}, zero, hn::Lt(zero, zero)};
  finish(x, inside);
  if (hn::AllTrue(Lanes(), is_inside)) return inside;

  ClosestLanes closest = closest_on_side<1, 2>(x);
  const ClosestLanes second = closest_on_side<2, 3>(x), third = closest_on_side<3, 1>(x);
  select(hn::Lt(second.distance, closest.distance), second, closest);
  select(hn::Lt(third.distance, closest.distance), third, closest);
  select(is_inside, inside, closest);
  return closest;
}

HWY_INLINE ClosestLanes closest_edges(const LaneVec3* x) {
  const Lane zero = same(0.0), one = same(1.0);
  const LaneVec3 first = minus(x[1], x[0]), second = minus(x[3], x[2]), r = minus(x[0], x[2]);
  const Lane a = dot(first, first), b = dot(first, second), e = dot(second, second), c = dot(first, r), f = dot(second, r);
  const Lane denominator = a * e - b * b;
  Lane s = choose(hn::Lt(zero, denominator), from_0_to_1((b * f - c * e) / denominator), zero);
  Lane t = choose(hn::Lt(zero, e), (b * s + f) / e, zero);
  const auto is_beyond = hn::Or(hn::Lt(t, zero), hn::Lt(one, t));
  const Lane end = from_0_to_1(t);
  s = choose(is_beyond, choose(hn::Lt(zero, a), from_0_to_1((b * end - c) / a), zero), s);
  t = choose(is_beyond, end, t);
  const auto is_inside = hn::And(hn::And(hn::Lt(zero, s), hn::Lt(s, one)), hn::And(hn::Lt(zero, t), hn::Lt(t, one)));
  ClosestLanes closest{{one - s, s, zero - (one - t), zero - t}, {}, zero, hn::Lt(choose(is_inside, zero, same(-1.0)), zero)};
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
  HWY_INLINE LaneVec3 at(int i, int p) const {
    LaneVec3 at;
    Lane unused;
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
    const LaneVec3 x[4] = {gathered.at(0, p), gathered.at(1, p), gathered.at(2, p), gathered.at(3, p)};
    const ClosestLanes closest = kind == FeaturePair::PointFace ? closest_point_face(x) : closest_edges(x);
    for (int c = 0; c < 4; ++c) hn::Store(closest.weight[c], d, block.weight[c] + p);
    hn::Store(closest.separation.x, d, block.separation[0] + p);
    hn::Store(closest.separation.y, d, block.separation[1] + p);
    hn::Store(closest.separation.z, d, block.separation[2] + p);
    hn::Store(closest.distance, d, block.distance + p);
    hn::Store(choose(closest.is_at_end, same(1.0), same(0.0)), d, block.is_at_end + p);
  }
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

Closest closest_points(FeaturePair kind, const FourPoints& x) {
  FeatureBlock block;
  block.points[0] = {0, 1, 2, 3};
  block.count = 1;
  find_closest(kind, x, block);
  return block.closest(0);
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

}  // namespace hooke
#endif
