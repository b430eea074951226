#include "formats/png_picture.h"

#include <png.h>

#include <algorithm>
#include <array>

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

bool is_png(std::string_view file) { return file.starts_with("\x89PNG\r\n\x1a\n"); }

// The file without the text and color profiles before the pixels, of which nothing is drawn. libpng reserves what a chunk declares before
// it reads it, and inflates them without a limit: a few bytes could take gigabytes.
std::string without_text(std::string_view bytes, const std::string& name) {
  constexpr std::size_t signature = 8, frame = 12;  // length, type and checksum around the data of a chunk
  constexpr std::array<std::string_view, 4> unused{"tEXt", "zTXt", "iTXt", "iCCP"};
  std::string kept(bytes.substr(0, signature));
  std::size_t at = kept.size();
  while (bytes.size() - at >= frame) {
    std::size_t length = 0;
    for (const char byte : bytes.substr(at, 4)) length = length << 8 | static_cast<unsigned char>(byte);
    const std::string_view type = bytes.substr(at + 4, 4);
    if (type == "IDAT") break;
    if (length > bytes.size() - at - frame)
      throw InputError(name + ": chunk at byte " + std::to_string(at) + " of " + std::to_string(length) +
                       " bytes, which the file does not have: must be a PNG");
    if (std::ranges::find(unused, type) == unused.end()) kept += bytes.substr(at, frame + length);
    at += frame + length;
  }
  return kept.append(bytes.substr(at));
}

}  // namespace

Picture decode_png(std::string_view file, const std::string& name) {
  PngImage image;
  const auto refuse = [&] { throw InputError(name + ": " + printable(image.png.message) + ": must be a PNG"); };
  const std::string bytes = is_png(file) ? without_text(file, name) : std::string(file);
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
                                  .description = "The current view of the scene, or the window.",
                                  .has_alpha = true};

namespace {

constexpr FileKind film_kind(std::string_view extension, std::string_view label, std::string_view description, bool has_alpha = false) {
  return {.extension = extension,
          .title = label,
          .source = ExportSource::Film,
          .label = label,
          .description = description,
          .has_alpha = has_alpha};
}

}  // namespace

constinit const FileKind film_file = film_kind(".mp4", "Film", "The view from now on, until F12; needs ffmpeg.");
constinit const FileKind webp_file =
    film_kind(".webp", "Animated picture", "The view from now on, until F12. Files are small, and browsers play them.", true);
constinit const FileKind gif_file = film_kind(
    ".gif", "Animated picture", "The view from now on, until F12. Every program plays it, but files are large and have 255 colors.");

}  // namespace hooke
