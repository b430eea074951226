#include "app/media/animation_encoder.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "draw/view.h"

namespace hooke {
namespace {

std::string big_endian(std::uint32_t value, int bytes = 4) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xff);
  return text;
}

// [bytes], of the signature and the header of a PNG.
constexpr std::size_t header_bytes = 8 + 25;

std::string control_data(std::uint32_t pictures) { return big_endian(pictures) + big_endian(0); }  // repeated for ever

std::string chunk(std::string_view type, std::string_view data) {
  const std::string content = std::string(type) + std::string(data);
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + content + big_endian(static_cast<std::uint32_t>(sum));
}

// The pixels that differ from the previous picture; the others are transparent, which takes little space.
Picture changes(const Picture& now, const Picture& before) {
  Picture changed{now.width, now.height, {}, 4};
  changed.pixels.reserve(now.pixels.size() / 3 * 4);
  for (std::size_t i = 0; i + 2 < now.pixels.size(); i += 3) {
    const bool is_same = !before.pixels.empty() && std::equal(&now.pixels[i], &now.pixels[i] + 3, &before.pixels[i]);
    for (std::size_t c = i; c < i + 3; ++c) changed.pixels.push_back(is_same ? 0 : now.pixels[c]);
    changed.pixels.push_back(is_same ? 0 : 255);
  }
  return changed;
}

}  // namespace

void AnimationEncoder::write_chunk(std::string_view type, std::string_view data) { out_.write(chunk(type, data)); }

void AnimationEncoder::add(const Picture& picture, long frames) {
  const std::string png = encode_png(changes(picture, shown_));
  shown_ = picture;
  if (pictures_ == 0) {
    out_.write(std::string_view(png).substr(0, header_bytes));
    write_chunk("acTL", control_data(0));
  }
  const auto delay = static_cast<std::uint32_t>(std::lround(1000.0 * static_cast<double>(frames) / frame_rate_));
  write_chunk("fcTL", big_endian(sequence_++) + big_endian(static_cast<std::uint32_t>(picture.width)) +
                          big_endian(static_cast<std::uint32_t>(picture.height)) + big_endian(0) + big_endian(0) +
                          big_endian(std::min<std::uint32_t>(delay, 0xffff), 2) + big_endian(1000, 2) + '\0' + '\1');
  // the data chunks of the first picture stay as they are; those of the others are numbered
  for (std::size_t at = header_bytes; at + 12 <= png.size();) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(png[at + i])); };
    const std::size_t length = byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
    const std::string_view data = std::string_view(png).substr(at + 8, length);
    if (png.compare(at + 4, 4, "IDAT") == 0)
      pictures_ == 0 ? write_chunk("IDAT", data) : write_chunk("fdAT", big_endian(sequence_++) + std::string(data));
    at += 12 + length;
  }
  ++pictures_;
}

void AnimationEncoder::close() {
  if (pictures_ == 0) return;
  write_chunk("IEND", "");
  out_.overwrite(header_bytes, chunk("acTL", control_data(pictures_)));
  out_.commit();
}

}  // namespace hooke
