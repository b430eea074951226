#include "cli/commands/commands.h"

#include <iostream>
#include <memory>
#include <optional>

#include "base/number_text.h"
#include "base/printable.h"
#include "batch/capture.h"
#include "cli/interrupt.h"
#include "cli/progress_bar.h"
#include "cli/scene_options.h"
#include "lab/lab.h"
#include "lab/recording.h"
#include "ui/font_files.h"

namespace hooke {
namespace {

struct Options : CaptureOptions {
  std::shared_ptr<SceneOptions> scene;
  ExecutionOptions execution;
  std::optional<std::string> replay;  // a recording, instead of a scene
};

// Opens the scene, or a recording to be played.
Lab open_lab(const Options& options, std::shared_ptr<const Recording>& recording) {
  if (!options.replay) return Lab(open_scene(*options.scene), KeepStart::No);
  recording = std::make_shared<const Recording>(read_recording(*options.replay));
  Lab lab(*recording->start, KeepStart::No);
  lab.submit(Play{recording});
  lab.advance(0.0, [] { return true; });
  return lab;
}

int capture(const Options& options) {
  // check the command line before reading a large file
  parse_size(options.size);
  parse_destination(options.out);
  if (options.camera) parse_camera(*options.camera);
  if ((options.panels || options.stamp) && !options.scene->quiet &&
      (font_file("DejaVuSans.ttf").empty() || font_file("DejaVuSans-Bold.ttf").empty()))
    std::cerr << "warning: " << (assets_folder() / "fonts").string() << ": no DejaVu Sans: text is drawn with another font\n";
  std::shared_ptr<const Recording> recording;
  Lab lab = open_lab(options, recording);
  lab.set_execution(make_execution(lab, options.execution));
  if (!options.scene->quiet) print_device(lab.plan().execution);
  const double length = recording ? static_cast<double>(recording->frames) / lab.scene().settings.frame_rate : 0.0;
  catch_interrupts(lab);
  std::optional<ProgressBar> progress;
  const CaptureResults results = capture_frames(lab, options, length, [&](long done, long all) {
    if (!progress) progress.emplace(all, !options.scene->quiet);
    progress->show(done);
  });
  progress.reset();

  if (results.interrupted) return report_interrupted("pictures", {options.out}, lab.scene().state.time);
  if (!results.error_limit.empty()) std::cerr << results.error_limit << "\n";
  if (!lab.difference().empty())
    std::cerr << "warning: " << printable(*options.replay) << ": " << lab.difference() << "; what follows is the motion of this version\n";
  if (!results.diverged && results.error_limit.empty() && !results.tolerance_warning.empty()) {
    std::cerr << results.tolerance_warning << "\n";
    return exit_code::diverged;
  }
  if (!results.diverged) return results.error_limit.empty() ? exit_code::success : exit_code::check_failed;
  std::cerr << (options.replay ? explain_divergence(lab, nullptr, 0.0) : explain_divergence(lab, *options.scene, results.seconds)) << "\n";
  return exit_code::diverged;
}

}  // namespace

std::function<int()> declare_capture(CLI::App& app) {
  auto options = std::make_shared<Options>();
  options->scene = add_scene_options(app, SceneIs::Optional);
  app.add_option("--replay", options->replay,
                 "A recording (" + std::string(recording_extension) + ") to replay instead of SCENE, by default to its end")
      ->type_name("LOG");
  app.add_option("--out", options->out,
                 "A .png for the last picture only, a folder for all (frame_00000.png, ...), or a film: .mp4 (by ffmpeg), .webp or .gif")
      ->required()
      ->type_name("FILE|DIR");
  CLI::Option* seconds = app.add_option("--seconds", options->seconds, "Simulated time from the first picture to the last [s]; default: 0")
                             ->type_name("S")
                             ->transform(within(not_negative));
  app.add_option("--frames", options->frames, "Number of pictures, instead of --seconds")
      ->type_name("N")
      ->transform(within({.min = 1, .max = 1e9}))
      ->excludes(seconds);
  app.add_option("--fps", options->fps, "Pictures per simulated second [1/s]; default: 60, or the frame rate of the scene if lower")
      ->type_name("RATE")
      ->transform(within(positive));
  app.add_option("--size", options->size, "Width and height [px]")->type_name("WxH")->capture_default_str();
  app.add_option("--scale", options->scale, "Scale of points, lines and panels, for high-resolution pictures")
      ->type_name("S")
      ->transform(within({.min = 0.5, .max = 4.0}))
      ->capture_default_str();
  add_import_options(app, options->scene->import);
  add_threads_option(app, options->execution.threads);
  add_device_option(app, options->execution.device);
  app.add_flag("--ui", options->panels, "Include the panels of the window");
  app.add_option(
         "--report", options->report,
         "Write report.csv and report.json to this folder: time, error, predictability, energy balance, cost and hash of every picture")
      ->type_name("DIR");
  app.add_flag("--stamp", options->stamp, "Write the time, the error and the method into each picture");
  add_fail_above_option(app, options->fail_above);
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
