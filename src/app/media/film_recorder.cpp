#include "app/media/film_recorder.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/printable.h"

namespace hooke {
namespace {

// The maximum number of film frames that one picture covers, however long the window was not drawn.
constexpr long max_repeats = 60;

}  // namespace

void FilmRecorder::take(double now, const std::function<Picture(const PictureOptions&)>& draw) {
  const bool is_due = film_ && !is_ending_ && static_cast<long>((now - started_) * video_frame_rate) >= pictures_;
  // the frame that asked for the film still shows the dialog
  if (std::exchange(is_new_, false) || (!film_wanted_ && !is_due)) return;
  try {
    Picture picture = draw(options_);
    if (picture.pixels.empty()) return;
    if (const auto file = std::exchange(film_wanted_, std::nullopt)) {
      film_.emplace(*file, picture.width, picture.height, video_frame_rate);
      is_ending_ = false;
      width_ = picture.width;
      height_ = picture.height;
      started_ = now;
      pictures_ = 0;
    }
    take_for_film(std::move(picture), now);
  } catch (const std::runtime_error& error) {  // FileError, or a picture that is too large for the graphics card
    film_wanted_.reset();
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
