#include "app/media/film_writer.h"

#include <utility>

#include "base/errors.h"

namespace hooke {

FilmWriter::FilmWriter(std::filesystem::path file, int width, int height, double video_frame_rate)
    : file_(std::move(file)), film_(find_film_format(file_)(file_, width, height, video_frame_rate)) {
  thread_ = std::thread([this] { write(); });
}

FilmWriter::~FilmWriter() {
  {
    const std::lock_guard lock(mutex_);
    dropped_ = !ended_;
  }
  changed_.notify_one();
  if (dropped_) film_->abort();
  thread_.join();
}

bool FilmWriter::add(Picture picture, long times) {
  {
    const std::lock_guard lock(mutex_);
    if (queued_bytes_ > 0 && queued_bytes_ + picture.pixels.size() > max_waiting) return false;
    queued_bytes_ += picture.pixels.size();
    queue_.push_back({std::move(picture), times});
  }
  changed_.notify_one();
  return true;
}

void FilmWriter::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_one();
}

std::optional<std::string> FilmWriter::result() const {
  const std::lock_guard lock(mutex_);
  return result_;
}

std::optional<FilmWriter::QueuedFrame> FilmWriter::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return dropped_ || ended_ || !queue_.empty(); });
  if (dropped_ || queue_.empty()) return std::nullopt;
  QueuedFrame queued_frame = std::move(queue_.front());
  queue_.pop_front();
  queued_bytes_ -= queued_frame.picture.pixels.size();
  return queued_frame;
}

void FilmWriter::write() {
  std::string error = write_all();
  const std::lock_guard lock(mutex_);
  result_ = std::move(error);
}

std::string FilmWriter::write_all() {
  try {
    while (const auto queued_frame = next()) film_->add(queued_frame->picture, queued_frame->times);
    if (!dropped_) film_->close("");
    return {};
  } catch (const std::exception& error) {  // FileError, or a picture that cannot be encoded
    return error.what();
  }
}

}  // namespace hooke
