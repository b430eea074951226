#include "app/film_writer.h"

#include <utility>

#include "sim/errors.h"

namespace hooke {

FilmWriter::FilmWriter(std::filesystem::path file, int width, int height, double pictures_per_second)
    : film_(std::move(file), width, height, pictures_per_second), thread_([this] { write(); }) {}

FilmWriter::~FilmWriter() {
  {
    const std::lock_guard lock(mutex_);
    dropped_ = !ended_;
  }
  changed_.notify_one();
  if (dropped_) film_.give_up();
  thread_.join();
}

bool FilmWriter::add(Picture picture, long times) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_bytes_ > 0 && waiting_bytes_ + picture.pixels.size() > most_waiting) return false;
    waiting_bytes_ += picture.pixels.size();
    waiting_.push_back({std::move(picture), times});
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

std::optional<FilmWriter::Shot> FilmWriter::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return dropped_ || ended_ || !waiting_.empty(); });
  if (dropped_ || waiting_.empty()) return std::nullopt;
  Shot shot = std::move(waiting_.front());
  waiting_.pop_front();
  waiting_bytes_ -= shot.picture.pixels.size();
  return shot;
}

void FilmWriter::write() {
  std::string error = write_all();
  const std::lock_guard lock(mutex_);
  result_ = std::move(error);
}

std::string FilmWriter::write_all() {
  try {
    while (const auto shot = next())
      for (long i = 0; i < shot->times; ++i) film_.add(shot->picture);
    if (!dropped_) film_.close();
    return {};
  } catch (const FileError& error) {
    return error.what();
  }
}

}  // namespace hooke
