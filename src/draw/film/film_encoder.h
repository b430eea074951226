// Files of moving pictures. Each format is one source file in this folder.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "scene/view_settings.h"

namespace hooke {

// Everything throws FileError. There is no file before `close`; without it, none is left.
class FilmEncoder {
 public:
  virtual ~FilmEncoder() = default;
  // A picture of the size of the film, shown for this many frames.
  virtual void add(const Picture& picture, long frames) = 0;
  virtual void close(const std::string& comment) = 0;  // in its metadata; empty: none
  // From any thread: an `add` that waits for another program fails.
  virtual void abort() {}
};

using StartFilm = std::unique_ptr<FilmEncoder>(const std::filesystem::path& file, int width, int height, double frame_rate);

StartFilm start_mp4;   // H.264 by ffmpeg; the error text says how to install it
StartFilm start_webp;  // at most 16383 pixels wide and high, opaque or not; the film is in memory until it is closed
StartFilm start_gif;   // 255 colors for what changes from one picture to the next, at most 50 pictures per second

// A comment as XMP metadata.
std::string xmp_packet(const std::string& description);

// By the extension: .mp4, .webp or .gif. Null: none of them.
StartFilm* find_film_format(const std::filesystem::path& file);

}  // namespace hooke
