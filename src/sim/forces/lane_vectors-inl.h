// Vectors of space, one for each lane, for kernels that Highway compiles once for each vector unit. Included once for each of them.
#if defined(HOOKE_SIM_FORCES_LANE_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HOOKE_SIM_FORCES_LANE_VECTORS_INL_H
#undef HOOKE_SIM_FORCES_LANE_VECTORS_INL_H
#else
#define HOOKE_SIM_FORCES_LANE_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include "base/types.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct LaneVector {
  V x, y, z;
};
template <class V>
HWY_INLINE LaneVector<V> plus(const LaneVector<V>& a, const LaneVector<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
HWY_INLINE LaneVector<V> minus(const LaneVector<V>& a, const LaneVector<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
HWY_INLINE LaneVector<V> times(V s, const LaneVector<V>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class V>
HWY_INLINE V dot(const LaneVector<V>& a, const LaneVector<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
HWY_INLINE LaneVector<V> cross(const LaneVector<V>& a, const LaneVector<V>& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
template <class M, class V>
HWY_INLINE LaneVector<V> choose(M mask, const LaneVector<V>& yes, const LaneVector<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

// Whole vectors.
using Lanes = hn::ScalableTag<double>;
using Lane = hn::Vec<Lanes>;
using LaneMask = hn::Mask<Lanes>;
using LaneVec3 = LaneVector<Lane>;
HWY_INLINE Lane same(double number) { return hn::Set(Lanes(), number); }
HWY_INLINE LaneVec3 same(const Vec3& a) { return {same(a.x), same(a.y), same(a.z)}; }

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
