#include "cli/commands/commands.h"

#include <algorithm>
#include <iostream>

#include "base/number_text.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "batch/capture_report.h"
#include "batch/engine/run_with_engine.h"
#include "batch/run_frames.h"
#include "batch/run_report.h"
#include "cli/interrupt.h"
#include "cli/output_options.h"
#include "cli/progress_bar.h"
#include "cli/scene_options.h"
#include "lab/accuracy/accuracy_text.h"
#include "lab/lab.h"
#include "sim/control/automatic.h"
#include "sim/methods/integrator.h"
#include "study/cost_advice.h"

namespace hooke {
namespace {

struct RunOptions {
  std::shared_ptr<SceneOptions> scene;
  double seconds = 0.0;  // [s]
  OutputOptions output;
  ExecutionOptions execution;
  std::optional<double> fail_above;   // [m]
  std::optional<std::string> engine;  // "mpirun -np 2 lmp"; none: this program computes the frames
};

// The error of the run, or what of it was not measured and why.
std::string accuracy_summary(const RunOptions& options, const Accuracy& accuracy) {
  if (!accuracy.is_on)
    return std::string("error of a frame, accumulated, predictability: not measured with ") +
           (options.engine ? "--engine" : "--accuracy off");
  const std::string time = accuracy.frame.value ? " at t = " + quantity_text(accuracy.frame_time, "s") : "";
  const std::string frame = "error of a frame" + time + ": " + error_text(accuracy.frame, accuracy.size);
  if (options.output.accuracy != AccuracyMode::Full && !options.fail_above)
    return frame + "; accumulated, predictability: not measured without --accuracy full";
  return frame + "; accumulated: " + error_text(accuracy.accumulated, accuracy.size) + "; " + predictability_text(accuracy);
}

void print_summary(const RunOptions& options, const Scene& scene, const RunTotals& totals, const Accuracy& accuracy) {
  const Settings& settings = scene.settings;
  const auto count = [](Index number, const char* one, const char* many) { return pluralize(static_cast<std::size_t>(number), one, many); };
  std::cout << printable(options.scene->scene) << ": " << count(scene.system.point_count(), "point", "points") << ", "
            << count(scene.system.spring_count(), "spring", "springs") << "; " << settings.integrator->id << ", "
            << (is_automatic(settings) ? "tolerance " + format_exact(automatic_tolerance(settings)) + " m/s"
                                       : count(settings.substeps, "substep", "substeps") + " per frame")
            << ", " << settings.frame_rate << " frames per second\n";
  if (scene.state.memory.choice && is_automatic(settings))
    std::cout << "last choice: " << describe(*scene.state.memory.choice, settings) << "\n";
  std::cout << "simulated " << totals.seconds << " s in " << totals.wall_seconds << " s (" << totals.cpu_seconds << " s of CPU), "
            << totals.force_evaluations << " force evaluations\n"
            << "hash " << to_hexadecimal(totals.hash) << "\n"
            << accuracy_summary(options, accuracy) << "\n";
}

bool has_summary(const RunOptions& options) { return !options.output.files.json && !options.output.files.csv && !options.scene->quiet; }

// What is measured by default: all of it for a file that contains it, the error of frames for the summary.
AccuracyMode default_accuracy(const RunOptions& options, const RunOutput& output) {
  if (output.needs_accuracy() || options.fail_above) return AccuracyMode::Full;
  return has_summary(options) ? AccuracyMode::Frame : AccuracyMode::Off;
}

// Writes the end of the files, or the summary if there are none.
void finish(const RunOptions& options, const Scene& scene, RunOutput& output, const RunTotals& totals, const Accuracy& accuracy) {
  output.finish(totals);
  if (has_summary(options)) print_summary(options, scene, totals, accuracy);
}

int run_engine(const RunOptions& options) {
  Scene scene = open_scene(*options.scene);
  const EngineRequest request{
      .command = *options.engine,
      .scene = options.scene->scene,
      .run = {
          .seconds = options.seconds, .sample = options.output.sample, .accuracy = options.output.accuracy.value_or(AccuracyMode::Off)}};
  RunOutput output(options.output.files, options.scene->scene, scene, parse_points(options.output.points, scene.system.point_count()),
                   {.device = *options.engine});
  if (output.has_chosen_errors()) throw UsageError("--quantities: the accuracy is not measured with --engine");
  RunHooks hooks = output.hooks();
  std::optional<ProgressBar> progress;
  progress.emplace(count_frames(options.seconds, scene.settings.frame_rate), !options.scene->quiet);
  hooks.progress = [&](long done, long) { progress->show(std::max(1l, done)); };

  // the engine has to be ended, and its files removed
  catch_interrupts();
  const EngineResults results = run_with_engine(scene, request, hooks, [] { return !was_interrupted(); });
  progress.reset();
  if (results.is_stopped) return std::cerr << "Interrupted: the engine was ended and nothing was written.\n", exit_interrupted();
  finish(options, scene, output, results.totals, {});
  if (!results.totals.diverged) return exit_code::success;
  std::cerr << results.divergence << "\n";
  return exit_code::diverged;
}

int run(const RunOptions& options) {
  require_separate_files(options.scene->scene,
                         {{"--json", options.output.files.json}, {"--csv", options.output.files.csv}, {"--pc2", options.output.files.pc2}});
  if (options.fail_above && options.output.accuracy.value_or(AccuracyMode::Full) != AccuracyMode::Full)
    throw UsageError("--fail-above: requires --accuracy full");
  if (options.engine) return run_engine(options);
  Lab lab(open_scene(*options.scene), KeepStart::No);
  lab.set_execution(make_execution(lab, options.execution));
  if (!options.scene->quiet) print_device(lab.plan().execution);
  const Scene& scene = lab.scene();
  RunRequest request{.seconds = options.seconds, .sample = options.output.sample};
  const long frames = count_frames(request.seconds, scene.settings.frame_rate);
  const auto points = parse_points(options.output.points, scene.system.point_count());

  // open the files first, so that an invalid path is reported before the work
  RunOutput output(options.output.files, options.scene->scene, scene, points, computed_by(lab.plan().execution));
  if (const auto warning = output.warning(); warning && !options.scene->quiet) std::cerr << "warning: " << *warning << "\n";
  request.accuracy = options.output.accuracy.value_or(default_accuracy(options, output));
  RunHooks hooks = output.hooks();
  std::optional<ProgressBar> progress;
  progress.emplace(frames, !options.scene->quiet);
  hooks.progress = [&](long done, long) { progress->show(done); };
  std::optional<ErrorLimit> limit;
  if (options.fail_above) {
    limit.emplace(*options.fail_above);
    hooks.frame = [&, frame = 0l, write = hooks.frame]() mutable {
      if (frame > 0) limit->check(lab, "frame " + std::to_string(frame));
      ++frame;
      return write ? write() : true;
    };
  }
  catch_interrupts(lab);
  const RunResults results = run_frames(lab, request, hooks);
  progress.reset();

  finish(options, scene, output, results.totals, lab.accuracy());
  if (!options.scene->quiet) {
    for (const std::string& warning : results.warnings) std::cerr << "warning: " << warning << "\n";
    // opened again, because a copy of a large scene is not kept during the run
    if (!results.totals.diverged && !results.totals.interrupted && tolerance_to_try(lab.accuracy(), scene.settings))
      if (const auto advice = advise_on_tolerance(load_with_options(*options.scene).scene, frames, lab.accuracy()))
        std::cerr << *advice << "\n";
  }
  const RunFiles& files = options.output.files;
  if (results.totals.interrupted) return report_interrupted("results", {files.json, files.csv, files.pc2}, scene.state.time);
  if (limit && !limit->message().empty()) {
    std::cerr << limit->message() << "\n";
    if (!results.totals.diverged) return exit_code::check_failed;
  }
  if (!results.totals.diverged) return results.totals.frames_beyond_tolerance.value_or(0) > 0 ? exit_code::diverged : exit_code::success;
  std::cerr << explain_divergence(lab, *options.scene, options.seconds, results.before_end.get()) << "\n";
  return exit_code::diverged;
}

}  // namespace

std::function<int()> declare_run(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  options->scene = add_scene_options(app);
  add_import_options(app, options->scene->import);
  app.add_option("--seconds", options->seconds, "Simulated time, rounded up to whole frames [s]")
      ->required()
      ->type_name("S")
      ->transform(within(not_negative));
  add_output_options(app, options->output, Summary::WithErrorOfFrame);
  app.add_option("--pc2", options->output.files.pc2, "Write the positions of all points in every frame as a point cache")
      ->type_name("FILE");
  add_fail_above_option(app, options->fail_above);
  add_threads_option(app, options->execution.threads);
  add_device_option(app, options->execution.device);
  app.add_option("--precision", options->execution.precision,
                 "double, the default, or single for twice the speed: velocity_verlet and symplectic_euler, for grids of springs without "
                 "dashpots, with gravity "
                 "and air")
      ->type_name("double|single")
      ->transform(one_of({"double", "single"}));
  app.add_option("--engine", options->engine,
                 "Let LAMMPS compute the frames: a command such as \"mpirun -np 8 lmp\", whose words are separated by blanks")
      ->type_name("COMMAND")
      ->excludes(app.get_option("--threads"))
      ->excludes(app.get_option("--device"))
      ->excludes(app.get_option("--fail-above"))
      ->excludes(app.get_option("--precision"));
  return [options] { return run(*options); };
}

}  // namespace hooke
