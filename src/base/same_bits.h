#pragma once

#include <bit>
#include <cstdint>

#include "base/types.h"

namespace hooke {

// Stricter than ==: 0.0 and -0.0 differ, and a NaN equals itself.
inline bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
inline bool same_bits(const Vec3& a, const Vec3& b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z); }

}  // namespace hooke
