// Pictures, films and recordings of the scene, written to the folder of the document.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/document/document.h"
#include "app/media/film_recorder.h"

namespace hooke {

class Captures {
 public:
  Captures(ToolContext& context, Panels& panels, const Document& document) : context_(context), panels_(panels), document_(document) {}

  // The main loop draws the picture.
  struct WantedPicture {
    std::filesystem::path file;
    PictureOptions options;
  };
  void take_picture() { take_picture(document_.new_file_beside(".png"), {}); }
  void take_picture(std::filesystem::path file, const PictureOptions& options) { picture_ = {std::move(file), options}; }
  // The picture to be written, once.
  std::optional<WantedPicture> take_wanted_picture() { return std::exchange(picture_, std::nullopt); }
  void write_picture(const WantedPicture& wanted, const std::function<Picture(const PictureOptions&)>& draw);

  // A file of a film format (draw/film/film_encoder.h).
  void start_film(const std::filesystem::path& file, const PictureOptions& options);
  void start_or_stop_film();
  void start_or_stop_recording();
  // Once per frame: reports what has been written, and errors.
  void poll();
  // At the end of the program: finishes the film and the recording.
  void end();

  FilmRecorder& film_recorder() { return film_recorder_; }
  double film_seconds() const { return film_recorder_.is_filming() ? film_recorder_.seconds() : -1.0; }
  bool is_busy() const { return picture_ || film_recorder_.is_filming() || film_recorder_.is_writing(); }

 private:
  ToolContext& context_;
  Panels& panels_;
  const Document& document_;
  std::optional<WantedPicture> picture_;
  FilmRecorder film_recorder_;
  std::filesystem::path recording_;  // empty if none is in progress
};

}  // namespace hooke
