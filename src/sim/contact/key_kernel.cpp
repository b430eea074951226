// Compiled once for each vector unit by Highway, which picks one at run time.
#include "sim/contact/key_kernel.h"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/key_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Without branches on keys, which would be mispredicted.
std::size_t find_low(std::span<const double> keys, std::span<KeyRange> ranges, KeyPlace* places) {
  const hn::ScalableTag<double> d;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  std::size_t count = 0;
  for (KeyRange& range : ranges) {
    const auto limit = hn::Set(d, range.limit);
    auto least = hn::Set(d, range.min);
    for (Index i = range.begin; i < range.end; i += lanes) {
      const auto is_of_range = hn::FirstN(d, static_cast<std::size_t>(range.end - i));
      const auto key = hn::IfThenElse(is_of_range, hn::LoadU(d, keys.data() + i), hn::Inf(d));
      least = hn::Min(least, key);
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, hn::Lt(key, limit), bits);
      for (Index lane = 0; lane < lanes; ++lane) {
        places[count] = {i + lane, range.group};
        count += (bits[0] >> static_cast<unsigned>(lane)) & 1U;
      }
    }
    range.min = hn::GetLane(hn::MinOfLanes(d, least));
  }
  return count;
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(find_low);

std::size_t find_below(std::span<const double> keys, std::span<KeyRange> ranges, std::vector<KeyPlace>& places) {
  std::size_t most = key_padding;
  for (const KeyRange& range : ranges) most += static_cast<std::size_t>(range.end - range.begin);
  if (places.size() < most) places.resize(most);
  return HWY_DYNAMIC_DISPATCH(find_low)(keys, ranges, places.data());
}

}  // namespace hooke
#endif
