// A film made by ffmpeg, where it is installed: pictures go down a pipe, raw, without a shell.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <filesystem>

#include "sim/view_settings.h"

namespace hooke {

class Film {
 public:
  // A .mp4 (H.264) of pictures of this size. Nothing is at `file` before `close`. Throws FileError when ffmpeg cannot be
  // started, with the line that says how to get it.
  Film(std::filesystem::path file, int width, int height, double pictures_per_second);
  ~Film();  // a film that was not closed is thrown away
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  // Throws FileError when ffmpeg has ended, with what it said.
  void add(const Picture& picture);
  // Waits for ffmpeg and puts the film in its place. Throws FileError.
  void close();
  // Ends ffmpeg, from any thread: an `add` that waits for it fails.
  void give_up();
  const std::filesystem::path& file() const { return file_; }

 private:
  int finish();
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path file_, unfinished_, said_;
  int width_, height_;
  std::atomic<int> to_ffmpeg_ = -1;
  std::atomic<bool> given_up_ = false;
  pid_t ffmpeg_ = 0;
};

}  // namespace hooke
