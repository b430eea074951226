// Chooses the inputs on which a fuzzer also does what takes long. The choice depends on the bytes alone, so that a finding can be
// reproduced.
#pragma once

#include <cstdint>
#include <string_view>

namespace hooke {

// True for one of `count` inputs, by their hash (FNV-1a, 32 bits).
inline bool is_among(std::uint32_t count, std::string_view bytes) {
  std::uint32_t hash = 2166136261U;
  for (const char byte : bytes) hash = (hash ^ static_cast<std::uint8_t>(byte)) * 16777619U;
  return (hash >> 8U) % count == 0;
}

}  // namespace hooke
