#include "batch/picture_writer.h"

#include <utility>

#include "batch/output_file.h"

namespace hooke {

PictureWriter::PictureWriter(const Destination& destination, const PictureSize& size, double video_frame_rate) : destination_(destination) {
  if (destination.kind == Destination::Kind::Film)
    film_ = find_film_format(destination.path)(destination.path, size.width, size.height, video_frame_rate);
  thread_ = std::thread([this] { work(); });
}

PictureWriter::~PictureWriter() {
  if (!thread_.joinable()) return;
  if (film_) film_->abort();
  end();
}

void PictureWriter::add(Image picture, long number) {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return error_ || queue_.size() < max_waiting; });
    if (error_) std::rethrow_exception(error_);
    queue_.push_back({std::move(picture), number});
  }
  changed_.notify_all();
}

void PictureWriter::finish(const std::string& comment) {
  end();
  if (error_) std::rethrow_exception(error_);
  if (film_) film_->close(comment);
}

// There are no more pictures.
void PictureWriter::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PictureWriter::work() {
  try {
    while (const auto queued = next()) write(*queued);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    error_ = std::current_exception();
  }
  changed_.notify_all();
}

// None: everything is written.
std::optional<PictureWriter::QueuedPicture> PictureWriter::next() {
  std::optional<QueuedPicture> queued;
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_ || !queue_.empty(); });
    if (queue_.empty()) return std::nullopt;
    queued = std::move(queue_.front());
    queue_.pop_front();
  }
  changed_.notify_all();
  return queued;
}

void PictureWriter::write(const QueuedPicture& queued) {
  if (film_) return film_->add(queued.picture, 1);
  OutputFile file(destination_.file(queued.number).string(), Writing::OneOfMany);
  file.write(encode_png(queued.picture));
  file.close();
}

}  // namespace hooke
