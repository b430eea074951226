// Point caches (.pc2): where every point was in every frame, as programs for pictures take it up. Blender's modifier
// Mesh Cache plays one on a mesh with as many vertices, such as the scene's own .obj.
#pragma once

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>

#include "base/types.h"

namespace hooke {

// Writes one frame by frame; none is kept. Little end first:
//   char[12] "POINTCACHE2", int32 version 1, int32 points, float first frame 0, float frames per sample 1, int32 samples,
//   then float x y z [m] of every point, sample by sample.
// Until close() the file says that it holds no samples. All of it throws FileError.
class PointCacheWriter {
 public:
  PointCacheWriter(const std::filesystem::path& file, Index points);
  ~PointCacheWriter();
  PointCacheWriter(const PointCacheWriter&) = delete;
  PointCacheWriter& operator=(const PointCacheWriter&) = delete;

  // Positions [m] of all points in the next frame.
  void add(std::span<const Vec3> positions);

  // Writes how many there were, and makes sure that all of it arrived.
  void close();

 private:
  [[noreturn]] void fail(int reason);
  void write(const void* bytes, std::size_t count);

  std::string printable_name_;
  std::FILE* file_;
  std::int32_t points_, samples_ = 0;
};

}  // namespace hooke
