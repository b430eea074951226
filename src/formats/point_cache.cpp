#include "formats/point_cache.h"

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/errors.h"
#include "base/printable.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

static_assert(std::endian::native == std::endian::little && sizeof(float) == 4);

struct Header {
  char magic[12] = "POINTCACHE2";
  std::int32_t version = 1;
  std::int32_t points = 0;
  float first_frame = 0.0f;
  float frames_per_sample = 1.0f;
  std::int32_t samples = 0;
};
static_assert(sizeof(Header) == 32);

}  // namespace

PointCacheWriter::PointCacheWriter(const std::filesystem::path& file, Index points)
    : printable_name_(printable(file.native())), file_(std::fopen(file.c_str(), "wb")), points_(points) {
  if (!file_) fail(errno);
  const Header header{.points = points_};
  write(&header, sizeof header);
  // close() will go back to the header: not every file can
  if (std::fseek(file_, 0, SEEK_END) != 0) fail(errno);
}

PointCacheWriter::~PointCacheWriter() {
  if (file_) std::fclose(file_);
}

void PointCacheWriter::fail(int reason) {
  if (file_) std::fclose(file_);
  file_ = nullptr;
  throw FileError(printable_name_ + ": cannot be written: " + std::strerror(reason));
}

void PointCacheWriter::write(const void* bytes, std::size_t count) {
  if (std::fwrite(bytes, 1, count, file_) != count) fail(errno);
}

void PointCacheWriter::add(std::span<const Vec3> positions) {
  if (samples_ == std::numeric_limits<std::int32_t>::max()) throw FileError(printable_name_ + ": holds no more than 2147483647 frames");
  for (const Vec3& x : positions) {
    float rounded[3];
    for (int c = 0; c < 3; ++c) {
      rounded[c] = static_cast<float>(x[c]);
      if (!std::isfinite(rounded[c])) throw FileError(printable_name_ + ": has no place for a point at " + format_rounded(x[c]) + " m");
    }
    write(rounded, sizeof rounded);
  }
  ++samples_;
}

void PointCacheWriter::close() {
  const Header header{.points = points_, .samples = samples_};
  if (std::fseek(file_, 0, SEEK_SET) != 0) fail(errno);
  write(&header, sizeof header);
  std::FILE* file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail(errno);
}

}  // namespace hooke
