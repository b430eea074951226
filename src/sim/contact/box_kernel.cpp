// Compiled once for each vector unit by Highway, which picks one at run time.
#include "sim/contact/box_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/box_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using V = hn::Vec<Lanes>;

struct BoxLanes {
  V min[3], max[3];
};

HWY_INLINE BoxLanes same_in_all_lanes(const SurfaceBox& box) {
  const Lanes d;
  return {{hn::Set(d, box.min.x), hn::Set(d, box.min.y), hn::Set(d, box.min.z)},
          {hn::Set(d, box.max.x), hn::Set(d, box.max.y), hn::Set(d, box.max.z)}};
}

HWY_INLINE BoxLanes load_boxes(const SurfaceBoxes& boxes, Index i) {
  const auto load = [&](const auto& column) HWY_ATTR { return hn::LoadU(Lanes(), column.data() + i); };
  return {{load(boxes.min[0]), load(boxes.min[1]), load(boxes.min[2])}, {load(boxes.max[0]), load(boxes.max[1]), load(boxes.max[2])}};
}

// `limit` is a square.
HWY_INLINE auto are_close(const BoxLanes& a, const BoxLanes& b, V limit) {
  V sum = hn::Zero(Lanes());
  for (int c = 0; c < 3; ++c) {
    const V gap = hn::Max(hn::Zero(Lanes()), hn::Max(hn::Sub(a.min[c], b.max[c]), hn::Sub(b.min[c], a.max[c])));
    sum = hn::Add(sum, hn::Mul(gap, gap));
  }
  return hn::Le(sum, limit);
}

// A bit for each of the first `count` lanes, at least one.
template <class M>
HWY_INLINE unsigned bits_of(M mask, Index count) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Lanes(), mask, bytes);
  return count < static_cast<Index>(hn::Lanes(Lanes())) ? bytes[0] & ((1U << static_cast<unsigned>(count)) - 1U) : bytes[0];
}

template <class Use>
HWY_INLINE void for_bits(unsigned bits, const Use& use) {
  for (; bits != 0; bits &= bits - 1U) use(static_cast<Index>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)));
}

HWY_INLINE BoxLanes one_in_all_lanes(const SurfaceBoxes& boxes, Index i) {
  const auto set = [&](const auto& column) HWY_ATTR { return hn::Set(Lanes(), column[i]); };
  return {{set(boxes.min[0]), set(boxes.min[1]), set(boxes.min[2])}, {set(boxes.max[0]), set(boxes.max[1]), set(boxes.max[2])}};
}

std::size_t find_close(const BoxSet& first, const BoxSet& second, double reach, std::span<std::array<Index, 2>> close) {
  const auto lanes = static_cast<Index>(hn::Lanes(Lanes()));
  const V limit = hn::Set(Lanes(), reach * reach * (1.0 + 1e-12));  // more than rounding changes a sum of squares
  std::size_t count = 0;
  const bool is_same = &first.boxes == &second.boxes && first.range.begin == second.range.begin;
  // most boxes of one set are far from all of the other
  const BoxLanes bound = same_in_all_lanes(second.bound);
  for (Index from = first.range.begin; from < first.range.end; from += lanes)
    for_bits(bits_of(are_close(bound, load_boxes(first.boxes, from), limit), first.range.end - from), [&](Index lane_of_first) {
      const Index i = from + lane_of_first;
      const BoxLanes box = one_in_all_lanes(first.boxes, i);
      for (Index j = is_same ? i + 1 : second.range.begin; j < second.range.end; j += lanes)
        for_bits(bits_of(are_close(box, load_boxes(second.boxes, j), limit), second.range.end - j), [&](Index lane) {
          close[count++] = {i, j + lane};
        });
    });
  return count;
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(find_close);

std::size_t find_close_boxes(const BoxSet& first, const BoxSet& second, double reach, std::span<std::array<Index, 2>> close) {
  return HWY_DYNAMIC_DISPATCH(find_close)(first, second, reach, close);
}

}  // namespace hooke
#endif
