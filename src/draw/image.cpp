#include <png.h>

#include <stdexcept>

#include "base/atomic_write.h"
#include "draw/view.h"

namespace hooke {

std::string encode_png(const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = image.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  png.flags = PNG_IMAGE_FLAG_FAST;  // the default takes ten times as long for slightly smaller files
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error("the picture could not be encoded");
  bytes.resize(size);
  return bytes;
}

void write_png(const Image& image, const std::filesystem::path& file) { write_atomically(file, encode_png(image)); }

}  // namespace hooke
