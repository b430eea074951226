// Point caches (.pc2): the positions of all points in every frame. Blender's Mesh Cache modifier plays one back on a mesh with as
// many vertices, such as the scene exported as .obj.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "base/atomic_write.h"
#include "sim/model/state.h"

namespace hooke {

// Writes frame by frame; keeps none in memory. Little-endian:
//   char[12] "POINTCACHE2", int32 version 1, int32 points, float first frame 0, float frames per sample 1, int32 samples,
//   then float x y z [m] of every point, sample by sample.
// The file is replaced by `close`, as an AtomicFile (base/atomic_write.h). All members throw FileError.
class PointCacheWriter {
 public:
  PointCacheWriter(const std::filesystem::path& file, Index points);

  // Appends the positions [m] of all points in the next frame.
  void add(std::span<const Vec3> positions);

  // Writes the number of frames and moves the file to its final path.
  void close();

 private:
  std::string printable_name_;
  AtomicFile file_;
  std::int32_t points_, samples_ = 0;
};

// A sentence if the numbers of the format are coarse compared with the scene, because it is far from the origin.
std::optional<std::string> point_cache_warning(const State& state);

}  // namespace hooke
