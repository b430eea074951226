#include "batch/capture_options.h"

#include <cmath>

#include "base/formatted.h"
#include "base/option_error.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "batch/output_file.h"
#include "draw/camera_text.h"
#include "draw/film/film_encoder.h"

namespace hooke {
namespace {

constexpr double frame_tolerance = 1e-9;  // relative rounding error of a number of frames

}  // namespace

PictureSize parse_size(const std::string& text) {
  const std::vector<std::string_view> sides = split(text, 'x');
  const PictureSize size{parse_integer(sides[0]).value_or(0), parse_integer(sides.back()).value_or(0)};
  const auto is_side = [](int pixels) { return pixels >= 1 && pixels <= max_pixels; };
  if (sides.size() != 2 || !is_side(size.width) || !is_side(size.height))
    throw OptionError("size", printable(text, 80), "must be WIDTHxHEIGHT, each from 1 to " + std::to_string(max_pixels));
  return size;
}

CameraPose parse_camera(const std::string& text) {
  if (const auto pose = camera_from_text(text)) return *pose;
  throw OptionError("camera", printable(text, 80), "must be six numbers, of the eye and a different target [m]");
}

std::filesystem::path Destination::file(long number) const {
  if (kind != Kind::Folder) return path;
  return path / formatted("frame_%05ld.png", number);
}

Destination parse_destination(const std::string& out) {
  const std::filesystem::path path(out);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored) || (!out.empty() && !path.has_extension())) return {path, Destination::Kind::Folder};
  if (path.extension() == ".png") return {path, Destination::Kind::Picture};
  if (find_film_format(path) != nullptr) return {path, Destination::Kind::Film};
  throw OptionError("out", printable(out, 200),
                    "must end in .png, .mp4, .webp or .gif, or be a folder (a new one with a dot in its name must end in /)");
}

void prepare(const Destination& destination) {
  if (destination.kind == Destination::Kind::Film) return;  // its encoder starts before any work
  if (destination.kind == Destination::Kind::Picture) {
    const OutputFile can_be_written(destination.path.string());
    return;
  }
  make_folder(destination.path);
  // pictures of an earlier capture would follow a shorter one
  std::error_code error;
  for (std::filesystem::directory_iterator entry(destination.path, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_picture = name.starts_with("frame_") && name.ends_with(".png") && name.size() >= 15 &&
                            name.find_first_not_of("0123456789", 6) == name.size() - 4;
    if (std::error_code ignored; is_picture) std::filesystem::remove(entry->path(), ignored);
  }
}

CaptureSchedule::CaptureSchedule(const CaptureOptions& options, double frame_rate, double length) {
  const double fps = pictures_per_second_ = options.fps.value_or(std::min(60.0, frame_rate));
  if (fps > frame_rate * (1.0 + frame_tolerance))
    throw OptionError("fps", format_exact(fps), "must be at most the frame rate of the scene, " + format_exact(frame_rate));
  frames_per_picture_ = frame_rate / fps;
  constexpr double max = 1e15;
  const double last = options.frames ? static_cast<double>(*options.frames - 1)
                                     : std::floor(options.seconds.value_or(length) * fps * (1.0 + frame_tolerance) + frame_tolerance);
  if (!(last * frames_per_picture_ <= max))
    throw OptionError("seconds", format_exact(options.seconds.value_or(length)), "must be at most 1e15 frames");
  pictures_ = static_cast<long>(last) + 1;
}

long CaptureSchedule::frame_of(long picture) const {
  return static_cast<long>(std::ceil(static_cast<double>(picture) * frames_per_picture_ * (1.0 - frame_tolerance) - frame_tolerance));
}

}  // namespace hooke
