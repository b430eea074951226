// Films encoded by ffmpeg, if it is installed: raw pictures are passed through a pipe, without a shell.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <filesystem>

#include "scene/view_settings.h"

namespace hooke {

class VideoEncoder {
 public:
  // A .mp4 (H.264) of pictures of this size. There is no file before `close`. Throws FileError if ffmpeg cannot be started, with a message
  // that says how to install it.
  VideoEncoder(std::filesystem::path file, int width, int height, double video_frame_rate);
  ~VideoEncoder();  // an unfinished film is deleted
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;

  // Throws FileError with the output of ffmpeg if it has ended.
  void add(const Picture& picture);
  // Waits for ffmpeg and moves the film to its final path. Throws FileError.
  void close();
  // Ends ffmpeg, from any thread: a blocked `add` then fails.
  void abort();

 private:
  int finish();
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path file_, unfinished_, stderr_file_;
  int width_, height_;
  std::atomic<int> ffmpeg_socket_ = -1;
  std::atomic<bool> aborted_ = false;
  pid_t ffmpeg_ = 0;
};

}  // namespace hooke
