// The options of a capture, and their parsed forms.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "draw/camera.h"

namespace hooke {

struct CaptureOptions {
  std::string out;
  std::optional<double> seconds;  // [s]
  std::optional<long> frames;
  std::optional<double> fps;      // [1/s]
  std::string size = "1280x720";  // [px]
  double scale = 1.0;             // of points, lines and panels
  bool panels = false;
  std::optional<std::string> report;  // folder
  bool stamp = false;
  std::optional<double> fail_above;  // [m]
  bool measures_accuracy() const { return report || stamp || fail_above; }
  std::optional<std::string> camera;  // "x,y,z,x,y,z": the eye and its target
};

inline constexpr int max_pixels = 8192;  // of a side

struct PictureSize {
  int width, height;
};

inline constexpr PictureSize min_panel_size{320, 180};  // [px], of pictures with panels at scale 1

// Throws UsageError.
PictureSize parse_size(const std::string& text);
CameraPose parse_camera(const std::string& text);

// The destination of pictures: one file, a folder of numbered files, or a film.
struct Destination {
  enum class Kind { Picture, Folder, Film };
  std::filesystem::path path;
  Kind kind;
  std::filesystem::path file(long number) const;
};
// By extension: .png is a file, .mp4, .webp and .gif are films; a folder has none, ends in / or exists. Throws UsageError.
Destination parse_destination(const std::string& out);
// Creates the folder and removes pictures of earlier captures from it, or checks that the picture can be written, before any work is done.
// Throws FileError.
void prepare(const Destination& destination);

// Decides which frames become pictures: the start, then `fps` per simulated second, each the first frame that ends at or after its time,
// without interpolation.
class CaptureSchedule {
 public:
  // `length`: simulated time [s] without --seconds or --frames. Throws UsageError when pictures would be closer than frames.
  CaptureSchedule(const CaptureOptions& options, double frame_rate, double length);
  double video_frame_rate() const { return pictures_per_second_; }
  long pictures() const { return pictures_; }
  long frame_of(long picture) const;  // number of frames stepped before it

 private:
  double pictures_per_second_, frames_per_picture_;
  long pictures_;
};

}  // namespace hooke
