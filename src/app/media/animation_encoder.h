// Animated pictures (APNG), which browsers and office programs play and which need no other program to be written.
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/atomic_write.h"
#include "scene/view_settings.h"

namespace hooke {

class AnimationEncoder {
 public:
  // Everything throws FileError. There is no file before `close`.
  AnimationEncoder(const std::filesystem::path& file, double frame_rate) : out_(file), frame_rate_(frame_rate) {}
  // A picture, all of the same size, shown for this many frames.
  void add(const Picture& picture, long frames);
  void close();

 private:
  void write_chunk(std::string_view type, std::string_view data);

  AtomicFile out_;
  double frame_rate_;
  Picture shown_;               // the previous picture
  std::uint32_t pictures_ = 0;  // written so far
  std::uint32_t sequence_ = 0;  // number of the next fcTL or fdAT chunk
};

}  // namespace hooke
