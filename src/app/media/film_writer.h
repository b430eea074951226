// A film that is written on a thread of its own: whoever adds pictures never waits for ffmpeg.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "formats/video_encoder.h"

namespace hooke {

class FilmWriter {
 public:
  // Throws FileError when ffmpeg cannot be started.
  FilmWriter(std::filesystem::path file, int width, int height, double video_frame_rate);
  ~FilmWriter();  // a film that was not ended is thrown away, one that was is waited for
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  // The picture so many times; false: too many wait to be written, and it was not taken.
  bool add(Picture picture, long times);
  // There are no more pictures.
  void end();
  // Once the film is in its place or given up: empty, or why it was given up.
  std::optional<std::string> result() const;
  const std::filesystem::path& file() const { return film_.file(); }

 private:
  struct QueuedFrame {
    Picture picture;
    long times;
  };
  void write();
  std::string write_all();
  std::optional<QueuedFrame> next();

  // Of all that waits [bytes]: some pictures of a large screen.
  static constexpr std::size_t max_waiting = std::size_t{96} << 20;

  VideoEncoder film_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<QueuedFrame> queue_;
  std::size_t queued_bytes_ = 0;
  bool ended_ = false;
  std::atomic<bool> dropped_ = false;
  std::optional<std::string> result_;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace hooke
