#pragma once

#include <cstdint>

namespace hooke {

// sRGB, 8 bits per channel.
struct Color {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Color&) const = default;
};

}  // namespace hooke
