#include "cli/capture.h"

#include <iostream>

#include "cli/capture_options.h"
#include "cli/offscreen.h"
#include "cli/progress.h"
#include "draw/view.h"
#include "lab/lab.h"

namespace hooke {
namespace {

// The last published state into a file.
void take_picture(View& view, const Lab& lab, const Camera& camera, const ViewOptions& options, const PictureSize& size,
                  const std::filesystem::path& file) {
  view.draw(*lab.status()->snapshot, {}, camera, options, size.width, size.height, nullptr);
  write_png(view.read(), file);
}

int capture(const CaptureOptions& options) {
  const PictureSize size = parse_size(options.size);
  const Destination destination = parse_destination(options.out);
  std::optional<CameraPose> pose;
  if (options.camera) pose = parse_camera(*options.camera);
  Lab lab(open_scene(*options.scene), KeepStart::No);
  const Scene& scene = lab.scene();
  const Shutter shutter(options, scene.settings.frame_rate);
  prepare(destination);

  ViewSettings settings = scene.view;
  if (pose) settings.camera = pose;
  const Camera camera = make_camera(settings, scene.system, scene.state, static_cast<double>(size.width) / size.height);
  const ViewOptions look = options_for(settings, scene.print);

  const Offscreen offscreen;
  View view;
  const long last = shutter.pictures() - 1;
  Progress progress(shutter.frame_of(last), !options.scene->quiet);
  bool diverged = false;
  long frame = 0;
  for (long picture = 0; picture <= last && !diverged; ++picture) {
    for (; frame < shutter.frame_of(picture) && !diverged; ++frame) {
      diverged = !lab.step();
      progress.show(frame + 1);
    }

    // one file shows the end, and a run that diverged ends at its last sound frame
    const bool is_shown = destination.is_folder ? !diverged : picture == last || diverged;
    if (!is_shown) continue;
    lab.publish();
    take_picture(view, lab, camera, look, size, destination.file(picture));
  }

  if (!diverged) return exit_code::fine;
  lab.publish();
  std::cerr << lab.status()->message << "\n";
  return exit_code::diverged;
}

}  // namespace

std::function<int()> declare_capture(CLI::App& app) {
  auto options = std::make_shared<CaptureOptions>();
  options->scene = add_scene_options(app);
  app.add_option("--out", options->out, "A .png, for the last picture alone, or a folder, for all: frame_00000.png and so on")
      ->required()
      ->type_name("FILE.png|DIR");
  CLI::Option* seconds =
      app.add_option("--seconds", options->seconds, "Simulated time from the first picture to the last [s]; without it 0")
          ->type_name("S")
          ->check(within(not_negative));
  app.add_option("--frames", options->frames, "How many pictures, instead of --seconds")
      ->type_name("N")
      ->check(within({.least = 1, .most = 1e9}))
      ->excludes(seconds);
  app.add_option("--fps", options->fps, "Pictures per simulated second [1/s]; without it 60, or the scene's frame rate where that is less")
      ->type_name("RATE")
      ->check(within(positive));
  app.add_option("--size", options->size, "Width and height [px]")->type_name("WxH")->capture_default_str();
  app.add_option("--camera", options->camera,
                 "Where the eye is and what it looks at [m]; without it as the scene says, or so that all of it is seen")
      ->type_name("X,Y,Z,X,Y,Z");
  return [options] { return capture(*options); };
}

}  // namespace hooke
