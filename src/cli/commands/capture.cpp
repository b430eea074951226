#include "cli/commands/capture.h"

#include <array>
#include <cstdio>
#include <iostream>

#include "base/printable.h"
#include "cli/commands/capture_options.h"
#include "cli/commands/capture_report.h"
#include "cli/offscreen.h"
#include "cli/progress_bar.h"
#include "draw/view.h"
#include "formats/video_encoder.h"
#include "lab/accuracy/accuracy_text.h"
#include "lab/lab.h"
#include "lab/recording.h"
#include "ui/panels/static_panels.h"

namespace hooke {
namespace {

// Draws frames of the laboratory and writes them to the destination.
class FrameCapture {
 public:
  FrameCapture(const Destination& destination, const PictureSize& size, const CaptureSchedule& schedule, const Scene& scene,
               std::optional<CameraPose> pose, const CaptureOptions& options)
      : destination_(destination), size_(size), place_{0.0, 0.0, static_cast<double>(size.width), static_cast<double>(size.height)} {
    ViewSettings settings = scene.view;
    if (pose) settings.camera = pose;
    view_options_ = options_for(settings, scene.cloth_texture);
    view_options_.scale = options.scale;
    has_stamp_ = options.stamp;
    if (options.panels || options.stamp) {
      panels_.emplace(size.width, size.height, view_options_,
                      StaticPanels::Shown{.panels = options.panels, .accuracy = options.measures_accuracy()});
      if (options.panels) place_ = panels_->layout().scene;
      view_.upload_fonts();
    }
    const double aspect = place_.width / place_.height;
    camera_ =
        pose ? make_camera(settings, scene.system, scene.state, aspect) : make_scene_camera(settings, scene.system, scene.state, aspect);
    view_options_.place = {static_cast<int>(place_.x), static_cast<int>(place_.y), static_cast<int>(place_.width),
                           static_cast<int>(place_.height)};
    if (destination.kind == Destination::Kind::VideoEncoder)
      film_.emplace(destination.path, size.width, size.height, schedule.video_frame_rate());
  }

  bool takes_every_picture() const { return destination_.kind != Destination::Kind::Picture; }
  void take(Lab& lab, long number) {
    lab.publish();
    const Status& status = *lab.status();
    follow_scene(camera_, status.snapshot->state);
    const ImDrawData* panels = panels_ ? panels_->build(status, camera_, {}, has_stamp_ ? stamp_of(status) : "") : nullptr;
    view_.draw(*status.snapshot, {}, camera_, view_options_, size_.width, size_.height, panels);
    if (film_)
      film_->add(view_.read());
    else
      write_png(view_.read(), destination_.file(number));
  }
  std::string file_name(long number) const { return destination_.file(number).filename().string(); }
  void finish() {
    if (film_) film_->close();
  }

 private:
  // One line about the picture.
  static std::string stamp_of(const Status& status) {
    const Snapshot& snapshot = *status.snapshot;
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "t = %.3f s", snapshot.state.time);
    return std::string(time.data()) + "    " + accuracy_line(status.accuracy) + "    " + std::string(snapshot.settings.integrator->id) +
           ", " + std::to_string(snapshot.settings.substeps) + (snapshot.settings.substeps == 1 ? " substep" : " substeps");
  }

  Destination destination_;
  PictureSize size_;
  Offscreen offscreen_;
  View view_;
  std::optional<StaticPanels> panels_;
  bool has_stamp_ = false;
  Rect place_;  // of the scene
  Camera camera_;
  ViewOptions view_options_;
  std::optional<VideoEncoder> film_;
};

// Opens the scene, or a recording to be played.
Lab open_lab(const CaptureOptions& options, std::shared_ptr<const Recording>& recording) {
  if (!options.replay) return Lab(open_scene(*options.scene), KeepStart::No);
  recording = std::make_shared<const Recording>(read_recording(*options.replay));
  Lab lab(*recording->start, KeepStart::No);
  lab.submit(Play{recording});
  lab.advance(0.0, [] { return true; });
  return lab;
}

int capture(const CaptureOptions& options) {
  const PictureSize size = parse_size(options.size);
  const Destination destination = parse_destination(options.out);
  std::optional<CameraPose> pose;
  if (options.camera) pose = parse_camera(*options.camera);
  std::shared_ptr<const Recording> recording;
  Lab lab = open_lab(options, recording);
  const double frame_rate = lab.scene().settings.frame_rate;
  const CaptureSchedule schedule(options, frame_rate, recording ? static_cast<double>(recording->frames) / frame_rate : 0.0);
  prepare(destination);

  FrameCapture frame_capture(destination, size, schedule, lab.scene(), pose, options);
  if (options.measures_accuracy()) lab.submit(SetAccuracy{AccuracyMode::Full});
  lab.apply_pending();
  std::optional<CaptureReport> report;
  if (options.report) report.emplace(*options.report, lab.scene());
  std::optional<ErrorLimit> limit;
  if (options.fail_above) limit.emplace(*options.fail_above);
  const long last = schedule.pictures() - 1;
  ProgressBar progress(schedule.frame_of(last), !options.scene->quiet);
  bool is_running = true, diverged = false;
  long frame = 0;
  for (long picture = 0; picture <= last && is_running; ++picture) {
    for (; frame < schedule.frame_of(picture) && is_running; ++frame) {
      diverged = !lab.step();
      // stop a replay at the first difference from the recording
      is_running = !diverged && lab.difference().empty();
      if (limit && is_running) limit->check(lab, frame + 1);
      progress.show(frame + 1);
    }
    // a single picture shows the end, or the last valid frame of a run that stopped early
    const bool is_shown = frame_capture.takes_every_picture() ? is_running : picture == last || !is_running;
    if (is_shown) frame_capture.take(lab, picture);
    if (report && is_running)
      report->add(lab, frame_capture.takes_every_picture() || picture == last ? frame_capture.file_name(picture) : "");
  }
  frame_capture.finish();
  if (report) report->finish();
  if (limit && !limit->message().empty()) std::cerr << limit->message() << "\n";

  if (!lab.difference().empty()) std::cerr << printable(*options.replay) << ": " << lab.difference() << "\n";
  const bool is_exceeded = limit && !limit->message().empty();
  if (!diverged) return lab.difference().empty() && !is_exceeded ? exit_code::success : exit_code::check_failed;
  if (options.replay) {
    lab.publish();
    std::cerr << lab.status()->diagnosis.message << "\n";
  } else {
    std::cerr << explain_divergence(lab, *options.scene, static_cast<double>(schedule.frame_of(last)) / frame_rate) << "\n";
  }
  return exit_code::diverged;
}

}  // namespace

std::function<int()> declare_capture(CLI::App& app) {
  auto options = std::make_shared<CaptureOptions>();
  options->scene = add_scene_options(app, SceneIs::Optional);
  app.add_option("--replay", options->replay,
                 "A recording (" + std::string(recording_extension) + ") to replay instead of SCENE, by default to its end")
      ->type_name("LOG");
  app.add_option("--out", options->out, "A .png for the last picture only, a folder for all (frame_00000.png, ...), or a .mp4 (by ffmpeg)")
      ->required()
      ->type_name("FILE.png|DIR|FILE.mp4");
  CLI::Option* seconds = app.add_option("--seconds", options->seconds, "Simulated time from the first picture to the last [s]; default: 0")
                             ->type_name("S")
                             ->check(within(not_negative));
  app.add_option("--frames", options->frames, "Number of pictures, instead of --seconds")
      ->type_name("N")
      ->check(within({.min = 1, .max = 1e9}))
      ->excludes(seconds);
  app.add_option("--fps", options->fps, "Pictures per simulated second [1/s]; default: 60, or the frame rate of the scene if lower")
      ->type_name("RATE")
      ->check(within(positive));
  app.add_option("--size", options->size, "Width and height [px]")->type_name("WxH")->capture_default_str();
  app.add_option("--scale", options->scale, "Scale of points, lines and panels, for high-resolution pictures")
      ->type_name("S")
      ->check(within({.min = 0.5, .max = 4.0}))
      ->capture_default_str();
  app.add_flag("--ui", options->panels, "Include the panels of the window");
  app.add_option(
         "--report", options->report,
         "Write report.csv and report.json to this folder: time, error, predictability, energy balance, cost and hash of every picture")
      ->type_name("DIR");
  app.add_flag("--stamp", options->stamp, "Write the time, the error and the method into each picture");
  app.add_option("--fail-above", options->fail_above,
                 "Exit with 1 if the accumulated error exceeds this or is not known, and name the first such frame [m]")
      ->type_name("METRES")
      ->check(within(positive));
  app.add_option("--camera", options->camera, "Position of the eye and its target [m]; default: as in the scene, or showing all of it")
      ->type_name("X,Y,Z,X,Y,Z");
  return [options, &app] {
    const bool has_scene = app.count("SCENE") > 0;
    if (has_scene == options->replay.has_value()) throw UsageError("either SCENE or --replay is required (see --help)");
    if (const auto name = first_stepping_option(app); options->replay && name)
      throw UsageError(*name + ": not allowed with --replay, which uses the recorded settings");
    return capture(*options);
  };
}

}  // namespace hooke
