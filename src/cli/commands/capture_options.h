// What the command line of a capture says, in the types that the work needs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/scene_options.h"
#include "draw/camera.h"

namespace hooke {

struct CaptureOptions {
  std::shared_ptr<SceneOptions> scene;
  std::optional<std::string> replay;  // a recording, instead of a scene
  std::string out;
  std::optional<double> seconds;  // [s]
  std::optional<long> frames;
  std::optional<double> fps;      // [1/s]
  std::string size = "1280x720";  // [px]
  double scale = 1.0;             // of points, lines and panels
  bool panels = false;
  std::optional<std::string> camera;  // "x,y,z,x,y,z": the eye and its target
};

inline constexpr int max_pixels = 8192;  // of a side

struct PictureSize {
  int width, height;
};

// Throws UsageError.
PictureSize parse_size(const std::string& text);
CameraPose parse_camera(const std::string& text);

// Where pictures go: one file, a folder of numbered ones, or a film.
struct Destination {
  enum class Kind { Picture, Folder, VideoEncoder };
  std::filesystem::path path;
  Kind kind;
  std::filesystem::path file(long number) const;
};
// By the ending: .png is a file, .mp4 a film; a folder has none, or a / at its end, or is there. Throws UsageError.
Destination parse_destination(const std::string& out);
// Makes the folder, or sees that the picture can be written, before any work is done for it. Throws FileError.
void prepare(const Destination& destination);

// Which pictures are taken: the first at the start, then `fps` a simulated second, each of the first frame that ends at
// its time or after it; nothing is interpolated.
class CaptureSchedule {
 public:
  // `length`: simulated time [s] without --seconds or --frames. Throws UsageError when pictures would be closer than frames.
  CaptureSchedule(const CaptureOptions& options, double frame_rate, double length);
  double video_frame_rate() const { return pictures_per_second_; }
  long pictures() const { return pictures_; }
  long frame_of(long picture) const;  // how many frames are stepped before it

 private:
  double pictures_per_second_, frames_per_picture_;
  long pictures_;
};

}  // namespace hooke
