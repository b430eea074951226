#include "formats/point_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string_view>

#include "base/errors.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "formats/file_kinds.h"
#include "sim/model/bounding_box.h"

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

// The bytes of a value as stored in the file.
template <class Value>
std::string_view bytes_of(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

}  // namespace

PointCacheWriter::PointCacheWriter(const std::filesystem::path& file, Index points)
    : printable_name_(printable(file.native())), file_(file), points_(points) {
  const Header header{.points = points_};
  file_.write(bytes_of(header));
}

void PointCacheWriter::add(std::span<const Vec3> positions) {
  if (samples_ == std::numeric_limits<std::int32_t>::max()) throw FileError(printable_name_ + ": must have at most 2147483647 frames");
  for (const Vec3& x : positions) {
    float rounded[3];
    for (int c = 0; c < 3; ++c) {
      rounded[c] = static_cast<float>(x[c]);
      if (!std::isfinite(rounded[c])) throw FileError(printable_name_ + ": cannot represent a point at " + format_rounded(x[c]) + " m");
    }
    file_.write(bytes_of(rounded));
  }
  ++samples_;
}

void PointCacheWriter::close() {
  const Header header{.points = points_, .samples = samples_};
  file_.overwrite(0, bytes_of(header));
  file_.commit();
}

std::optional<std::string> point_cache_warning(const State& state) {
  constexpr double half_unit = 0x1p-24, max_relative_error = 1e-5;  // of a float; of the size of the scene
  const auto [min, max] = bounding_box(state.position);
  const Vec3 farthest = glm::max(glm::abs(min), glm::abs(max));
  const double error = half_unit * std::max({farthest.x, farthest.y, farthest.z});
  if (error <= max_relative_error * glm::distance(min, max)) return std::nullopt;
  return "point cache: positions are rounded by up to " + format_rounded(1000.0 * error) +
         " mm: the scene is far from the origin, compared with its size";
}

namespace {

class CacheSink : public FrameSink {
 public:
  CacheSink(const std::filesystem::path& file, Index points) : writer_(file, points) {}
  void add(const System&, const State& state, const Accuracy*) override { writer_.add(state.position); }
  void finish() override { writer_.close(); }

 private:
  PointCacheWriter writer_;
};

}  // namespace

constinit const FileKind pc2_file{
    .extension = ".pc2",
    .title = "Point cache",
    .open_frames = [](const std::filesystem::path& file, const System& system, const std::vector<Quantity>&) -> std::unique_ptr<FrameSink> {
      return std::make_unique<CacheSink>(file, system.point_count());
    },
    .source = ExportSource::Frames,
    .label = "Point cache",
    .description = "The position of each point in each frame from now on, for Blender's Mesh Cache modifier on the .obj."};

}  // namespace hooke
