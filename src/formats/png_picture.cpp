#include "formats/png_picture.h"

#include <png.h>

#include <algorithm>

#include "base/errors.h"
#include "base/file_limits.h"
#include "base/printable.h"
#include "formats/file_kinds.h"

namespace hooke {
namespace {

// [px]: no screen is larger, and textures need not be larger.
constexpr int max_decoded_side = 2048;

struct PngImage {
  png_image png{};
  PngImage() { png.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&png); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

// Each pixel is the mean of four; a last odd row or column is dropped.
Picture halved(const Picture& picture) {
  Picture half{std::max(1, picture.width / 2), std::max(1, picture.height / 2), {}};
  const int right = picture.width > 1 ? 1 : 0, below = picture.height > 1 ? 1 : 0;
  const auto at = [&](int x, int y, int channel) {
    return picture.pixels[3 * (static_cast<std::size_t>(y) * picture.width + x) + channel];
  };
  half.pixels.reserve(3 * static_cast<std::size_t>(half.width) * half.height);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const int left = x * (1 + right), top = y * (1 + below);
        const int sum = at(left, top, c) + at(left + right, top, c) + at(left, top + below, c) + at(left + right, top + below, c);
        half.pixels.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
      }
  return half;
}

}  // namespace

Picture decode_png(std::string_view bytes, const std::string& name) {
  PngImage image;
  const auto refuse = [&] { throw InputError(name + ": " + printable(image.png.message) + ": must be a PNG"); };
  if (!png_image_begin_read_from_memory(&image.png, bytes.data(), bytes.size())) refuse();
  const std::uint32_t width = image.png.width, height = image.png.height;
  if (width > max_picture_side || height > max_picture_side)
    throw InputError(name + ": " + std::to_string(width) + " x " + std::to_string(height) + " pixels: must be at most " +
                     std::to_string(max_picture_side) + " x " + std::to_string(max_picture_side));

  image.png.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(width), static_cast<int>(height), std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image.png))};
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&image.png, &white, picture.pixels.data(), 0, nullptr)) refuse();
  while (picture.width > max_decoded_side || picture.height > max_decoded_side) picture = halved(picture);
  return picture;
}

constinit const FileKind png_file{.extension = ".png",
                                  .title = "Picture",
                                  .source = ExportSource::Picture,
                                  .label = "Picture",
                                  .description = "The current view of the scene, without the panels."};

}  // namespace hooke
