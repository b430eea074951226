// A film that is written in a background thread: adding pictures never waits for its encoder.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "draw/film/film_encoder.h"

namespace hooke {

class FilmWriter {
 public:
  // A file of a film format. Throws FileError if it cannot be started.
  FilmWriter(std::filesystem::path file, int width, int height, double video_frame_rate);
  ~FilmWriter();  // deletes an unfinished film; waits for a finished one
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  // Adds the picture `times` times. Returns false, without adding it, if too many are waiting to be written.
  bool add(Picture picture, long times);
  // There are no more pictures.
  void end();
  // Once the film is written: empty, or an error text.
  std::optional<std::string> result() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  struct QueuedFrame {
    Picture picture;
    long times;
  };
  void write();
  std::string write_all();
  std::optional<QueuedFrame> next();

  // Limit of the waiting pictures [bytes]: some pictures of a large screen.
  static constexpr std::size_t max_waiting = std::size_t{96} << 20;

  std::filesystem::path file_;
  std::unique_ptr<FilmEncoder> film_;
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
