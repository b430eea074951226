#include "fuzz/png_input.h"

#include <zlib.h>

#include "formats/png_picture.h"
#include "fuzz/invariants.h"

namespace hooke {
namespace {

std::uint32_t read_whole(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

void decode(std::string_view bytes) {
  try {
    const Picture picture = decode_png(bytes, "fuzz.png");
    require(picture.width > 0 && picture.height > 0 && picture.width <= 2048 && picture.height <= 2048,
            "the size of a picture is within its limits");
    require(picture.pixels.size() == std::size_t{3} * picture.width * picture.height, "every pixel is present");
  } catch (const InputError& refused) {
    for (const char* c = refused.what(); *c != '\0'; ++c)
      require(static_cast<unsigned char>(*c) >= 0x20 && *c != 0x7f, "no control character in a message");
  }
}

}  // namespace

// A chunk: length (4 bytes, most significant first), type (4), data, CRC-32 of type and data (ISO 15948, section 5.3).
std::string with_checksums(std::string bytes) {
  constexpr std::size_t signature = 8;
  for (std::size_t at = signature; at + 12 <= bytes.size();) {
    const std::size_t length = read_whole(bytes, at);
    if (length > bytes.size() - at - 12) break;
    const auto sum =
        static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + at + 4), static_cast<uInt>(length + 4)));
    for (std::size_t i = 0; i < 4; ++i) bytes[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    at += 12 + length;
  }
  return bytes;
}

void try_as_png(std::string_view bytes) {
  decode(bytes);
  decode(with_checksums(std::string(bytes)));
}

}  // namespace hooke
