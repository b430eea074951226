// Films of the scene as shown in the window, or of the whole window.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/media/film_writer.h"
#include "ui/export_state.h"

namespace hooke {

class FilmRecorder {
 public:
  // Starts with the next frame; ends with end_film or when the size of the pictures changes.
  void start_film(std::filesystem::path file, const PictureOptions& options) {
    film_wanted_ = std::move(file);
    options_ = options;
    is_new_ = true;
  }
  void end_film();
  bool is_filming() const { return film_wanted_ || (film_ && !is_ending_); }
  // A film that has ended is still being written.
  bool is_writing() const { return film_.has_value(); }

  // After a frame was drawn: calls `draw` if the film needs a picture. `now` [s] is from any clock.
  void take(double now, const std::function<Picture(const PictureOptions&)>& draw);
  // A message, returned once: "Film saved to /home/a/cloth.mp4". Empty if there is none.
  std::string take_message();
  // Length of the film so far [s].
  double seconds() const { return static_cast<double>(pictures_) / video_frame_rate; }

  static constexpr double video_frame_rate = 30.0;

 private:
  void take_for_film(Picture picture, double now);

  std::optional<std::filesystem::path> film_wanted_;
  std::optional<FilmWriter> film_;
  bool is_ending_ = false, is_new_ = false;
  PictureOptions options_;
  int width_ = 0, height_ = 0;
  double started_ = 0.0;  // [s]
  long pictures_ = 0;
  std::string message_;
};

}  // namespace hooke
