#include "app/media/film_recorder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/errors.h"
#include "base/printable.h"

namespace hooke {
namespace {

// The maximum number of film frames that one picture covers, however long the window was not drawn.
constexpr long max_repeats = 60;

Picture cut(const Picture& whole, const Viewport& place) {
  const int left = std::clamp(place.x, 0, whole.width), top = std::clamp(place.y, 0, whole.height);
  const int width = std::clamp(place.width, 0, whole.width - left), height = std::clamp(place.height, 0, whole.height - top);
  Picture part{.width = width,
               .height = height,
               .pixels = std::vector<std::uint8_t>(3u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
  const std::size_t row = 3u * static_cast<std::size_t>(width);
  for (int y = 0; y < height && row > 0; ++y)
    std::memcpy(
        &part.pixels[row * static_cast<std::size_t>(y)],
        &whole.pixels[3u * (static_cast<std::size_t>(top + y) * static_cast<std::size_t>(whole.width) + static_cast<std::size_t>(left))],
        row);
  return part;
}

}  // namespace

void FilmRecorder::take(const View& view, const Viewport& place, double now) {
  const bool is_due = film_ && !is_ending_ && static_cast<long>((now - started_) * video_frame_rate) >= pictures_;
  if (!film_wanted_ && !is_due) return;
  Picture picture = has_panels_ ? view.read() : cut(view.read(), place);
  if (picture.pixels.empty()) return;
  try {
    if (const auto file = std::exchange(film_wanted_, std::nullopt)) {
      film_.emplace(*file, picture.width, picture.height, video_frame_rate);
      is_ending_ = false;
      width_ = picture.width;
      height_ = picture.height;
      started_ = now;
      pictures_ = 0;
    }
    take_for_film(std::move(picture), now);
  } catch (const FileError& error) {
    film_.reset();
    message_ = error.what();
  }
}

// A picture is repeated as often as real time requires. If ffmpeg is slower, the next picture that it accepts also covers those that it did
// not.
void FilmRecorder::take_for_film(Picture picture, double now) {
  if (picture.width != width_ || picture.height != height_) return end_film();
  const long due = static_cast<long>((now - started_) * video_frame_rate) + 1;
  if (film_->add(std::move(picture), std::min(due - pictures_, max_repeats))) pictures_ = due;
}

void FilmRecorder::end_film() {
  film_wanted_.reset();
  if (!film_) return;
  is_ending_ = true;
  film_->end();
}

std::string FilmRecorder::take_message() {
  if (const auto result = film_ ? film_->result() : std::nullopt) {
    message_ = result->empty() ? "Film saved to " + printable(film_->file().native()) : *result;
    film_.reset();
    is_ending_ = false;
  }
  return std::exchange(message_, {});
}

}  // namespace hooke
