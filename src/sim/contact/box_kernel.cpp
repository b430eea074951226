// Compiled once for each vector unit by Highway, which picks one at run time.
#include "sim/contact/box_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/box_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

std::size_t find_close(const BoxColumns& first, BoxRange in_first, const BoxColumns& second, BoxRange in_second, double reach,
                       std::span<std::array<Index, 2>> close) {
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  const V limit = hn::Set(d, reach);
  const bool is_same = &first == &second && in_first.begin == in_second.begin;
  std::size_t count = 0;
  for (Index i = in_first.begin; i < in_first.end; ++i) {
    const V min[3] = {hn::Set(d, first.min[0][i]), hn::Set(d, first.min[1][i]), hn::Set(d, first.min[2][i])};
    const V max[3] = {hn::Set(d, first.max[0][i]), hn::Set(d, first.max[1][i]), hn::Set(d, first.max[2][i])};
    for (Index j = is_same ? i + 1 : in_second.begin; j < in_second.end; j += lanes) {
      V gap = hn::Sub(min[0], hn::LoadU(d, second.max[0].data() + j));
      gap = hn::Max(gap, hn::Sub(hn::LoadU(d, second.min[0].data() + j), max[0]));
      for (int c = 1; c < 3; ++c) {
        gap = hn::Max(gap, hn::Sub(min[c], hn::LoadU(d, second.max[c].data() + j)));
        gap = hn::Max(gap, hn::Sub(hn::LoadU(d, second.min[c].data() + j), max[c]));
      }
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, hn::Le(gap, limit), bytes);
      unsigned bits = bytes[0];
      if (const Index left = in_second.end - j; left < lanes) bits &= (1U << static_cast<unsigned>(left)) - 1U;
      for (; bits != 0; bits &= bits - 1U) close[count++] = {i, j + static_cast<Index>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits))};
    }
  }
  return count;
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(find_close);

std::size_t find_close_boxes(const BoxColumns& first, BoxRange in_first, const BoxColumns& second, BoxRange in_second, double reach,
                             std::span<std::array<Index, 2>> close) {
  return HWY_DYNAMIC_DISPATCH(find_close)(first, in_first, second, in_second, reach, close);
}

}  // namespace hooke
#endif
