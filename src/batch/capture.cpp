#include "batch/capture.h"

#include <cmath>

#include "base/formatted.h"
#include "base/number_text.h"
#include "base/option_error.h"
#include "batch/capture_report.h"
#include "batch/offscreen.h"
#include "batch/picture_writer.h"
#include "batch/run_frames.h"
#include "draw/view.h"
#include "lab/accuracy/accuracy_text.h"
#include "lab/crossing_finder.h"
#include "sim/control/automatic.h"
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
    shows_panels_ = options.panels;
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
    writer_.emplace(destination, size, schedule.video_frame_rate());
  }

  bool takes_every_picture() const { return destination_.kind != Destination::Kind::Picture; }
  // Before the first frame: what crosses then is highlighted until it is apart, as in the window.
  void begin(Lab& lab) {
    if (!shows_panels_) return;
    lab.publish();
    crossing_finder_.follow(*lab.status());
  }
  void take(Lab& lab, long number) {
    lab.publish();
    const Status& status = *lab.status();
    if (shows_panels_) crossing_finder_.follow(status);
    follow_scene(camera_, status.snapshot->state);
    const Marks marks{.crossed = crossing_finder_.found()};
    const ImDrawData* panels = panels_ ? panels_->build(status, camera_, {}, has_stamp_ ? stamp_of(status) : "", &marks) : nullptr;
    view_.draw(*status.snapshot, marks, camera_, view_options_, size_.width, size_.height, panels);
    writer_->add(view_.read(), number);
  }
  std::string file_name(long number) const { return destination_.file(number).filename().string(); }
  // The name of a frame in messages: the picture that shows it, or "before" the next picture.
  std::string name_of(const CaptureSchedule& schedule, long picture, long frame) const {
    if (destination_.kind != Destination::Kind::Folder) return "frame " + std::to_string(frame);
    return (frame == schedule.frame_of(picture) ? "" : "before ") + file_name(picture);
  }
  void finish(const std::string& comment) { writer_->finish(comment); }

 private:
  // One line about the picture.
  static std::string stamp_of(const Status& status) {
    const Snapshot& snapshot = *status.snapshot;
    return formatted("t = %.3f s", snapshot.state.time) + "    " + accuracy_line(status.accuracy) + "    " +
           std::string(snapshot.settings.integrator->id) +
           (is_automatic(snapshot.settings) && snapshot.state.memory.choice
                ? ": " + describe(*snapshot.state.memory.choice, snapshot.settings)
                : ", " + std::to_string(snapshot.settings.substeps) + (snapshot.settings.substeps == 1 ? " substep" : " substeps"));
  }

  Destination destination_;
  PictureSize size_;
  Offscreen offscreen_;
  View view_;
  std::optional<StaticPanels> panels_;
  CrossingFinder crossing_finder_;
  bool has_stamp_ = false, shows_panels_ = false;
  Rect place_;  // of the scene
  Camera camera_;
  ViewOptions view_options_;
  std::optional<PictureWriter> writer_;
};

}  // namespace

CaptureResults capture_frames(Lab& lab, const CaptureOptions& options, double length,
                              const std::function<void(long done, long all)>& progress) {
  const PictureSize size = parse_size(options.size);
  // the panels need space
  const int min_width = static_cast<int>(std::ceil(min_panel_size.width * options.scale));
  const int min_height = static_cast<int>(std::ceil(min_panel_size.height * options.scale));
  if (options.panels && (size.width < min_width || size.height < min_height))
    throw OptionError("size", options.size,
                      "must be at least " + std::to_string(min_width) + "x" + std::to_string(min_height) + " with panels of this scale");
  const Destination destination = parse_destination(options.out);
  std::optional<CameraPose> pose;
  if (options.camera) pose = parse_camera(*options.camera);
  const CaptureSchedule schedule(options, lab.scene().settings.frame_rate, length);
  prepare(destination);

  FrameCapture frame_capture(destination, size, schedule, lab.scene(), pose, options);
  // the panels show the error of a frame
  if (options.measures_accuracy() || options.panels)
    lab.submit(SetAccuracy{options.measures_accuracy() ? AccuracyMode::Full : AccuracyMode::Frame});
  lab.apply_pending();
  frame_capture.begin(lab);
  std::optional<CaptureReport> report;
  if (options.report) report.emplace(*options.report, lab.scene());
  std::optional<ErrorLimit> limit;
  if (options.fail_above) limit.emplace(*options.fail_above);
  const long last = schedule.pictures() - 1;
  const long frames = schedule.frame_of(last);
  CaptureResults results;
  results.seconds = static_cast<double>(frames) / lab.scene().settings.frame_rate;
  ToleranceMonitor tolerance;
  bool is_running = true;
  long frame = 0;
  for (long picture = 0; picture <= last && is_running; ++picture) {
    for (; frame < schedule.frame_of(picture) && is_running; ++frame) {
      try {
        results.diverged = !lab.step();
      } catch (const Interrupted&) {
        results.interrupted = true;
      }
      is_running = !results.diverged && !results.interrupted;
      if (is_running) tolerance.add_frame(lab.scene().settings, lab.scene().state);
      if (limit && is_running) limit->check(lab, frame_capture.name_of(schedule, picture, frame + 1));
      progress(frame + 1, frames);
    }
    // a single picture shows the end, or the last valid frame of a run that stopped early
    const bool is_shown = frame_capture.takes_every_picture() ? is_running : picture == last || !is_running;
    if (is_shown) frame_capture.take(lab, picture);
    if (report && is_running)
      report->add(lab, frame_capture.takes_every_picture() || picture == last ? frame_capture.file_name(picture) : "");
  }
  frame_capture.finish(results.interrupted ? "interrupted at t = " + number_text(lab.scene().state.time) + " s" : "");
  if (report) report->finish(results.interrupted);
  if (limit) results.error_limit = limit->message();
  results.tolerance_warning = tolerance.warning();
  return results;
}

}  // namespace hooke
