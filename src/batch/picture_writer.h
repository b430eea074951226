// Encodes and writes the pictures of a capture in a thread of its own, beside stepping and drawing.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "batch/capture_options.h"
#include "draw/film/film_encoder.h"
#include "draw/view.h"

namespace hooke {

class PictureWriter {
 public:
  // A film starts with its encoder, and throws FileError if that cannot be started.
  PictureWriter(const Destination& destination, const PictureSize& size, double video_frame_rate);
  ~PictureWriter();  // waits until numbered pictures are written, whatever their errors; deletes a film that is not finished
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  // Pictures are written in the order in which they are added. Waits where too many are waiting. Throws the error of an earlier picture,
  // after which none is written.
  void add(Image picture, long number);
  // Waits until everything is written. The comment is that of a film. Throws FileError.
  void finish(const std::string& comment);

 private:
  struct QueuedPicture {
    Image picture;
    long number;
  };
  void work();
  std::optional<QueuedPicture> next();
  void write(const QueuedPicture& queued);
  void end();

  // They even out pictures that take longer than others; one of them can have 200 MB.
  static constexpr std::size_t max_waiting = 2;

  Destination destination_;
  std::unique_ptr<FilmEncoder> film_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<QueuedPicture> queue_;
  bool ended_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace hooke
