#include "app/media/captures.h"

#include "app/document/system_dialog.h"
#include "base/printable.h"
#include "draw/view.h"
#include "lab/recording.h"

namespace hooke {

void Captures::write_picture(const WantedPicture& wanted, const std::function<Picture(const PictureOptions&)>& draw) {
  try {
    write_png(draw(wanted.options), wanted.file);
    panels_.show_toast("Picture saved to " + printable(wanted.file.native()));
  } catch (const std::runtime_error& error) {  // FileError, or a picture that is too large for the graphics card
    panels_.show_message("Cannot write the picture", error.what());
  }
}

void Captures::start_film(const std::filesystem::path& file, const PictureOptions& options) {
  if (film_recorder_.is_filming() || film_recorder_.is_writing()) return panels_.show_toast("A film is being written: try again later");
  film_recorder_.start_film(file, options);
}

void Captures::start_or_stop_film() {
  if (film_recorder_.is_filming())
    film_recorder_.end_film();
  else
    start_film(document_.new_file_beside(find_program("ffmpeg").empty() ? ".webp" : ".mp4"), {});
}

void Captures::start_or_stop_recording() {
  if (recording_.empty()) {
    recording_ = document_.new_file_beside(recording_extension);
    context_.lab.submit(Record{std::make_shared<const std::filesystem::path>(recording_)});
  } else {
    context_.lab.submit(Record{});
    panels_.show_toast("Recording saved to " + printable(recording_.native()));
    recording_.clear();
  }
}

void Captures::poll() {
  if (const std::string message = film_recorder_.take_message(); !message.empty()) panels_.show_toast(message);
  const std::string& error = context_.status->recording.error;
  if (!error.empty() && !std::exchange(recording_, {}).empty()) panels_.show_toast(error);
}

void Captures::end() {
  film_recorder_.end_film();
  context_.lab.submit(Record{});
}

}  // namespace hooke
