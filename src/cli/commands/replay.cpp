#include "cli/commands/commands.h"

#include <iostream>

#include "base/number_text.h"
#include "base/printable.h"
#include "batch/junit.h"
#include "batch/output_file.h"
#include "batch/run_frames.h"
#include "cli/interrupt.h"
#include "cli/output_options.h"
#include "cli/progress_bar.h"
#include "cli/scene_options.h"
#include "lab/lab.h"
#include "lab/recording.h"

namespace hooke {
namespace {

struct ReplayOptions {
  std::string log;
  bool verify = false, quiet = false;
  std::optional<std::string> junit;
  int threads = 1;
  OutputOptions output;
};

int replay(const ReplayOptions& options) {
  require_separate_files(options.log,
                         {{"--json", options.output.files.json}, {"--csv", options.output.files.csv}, {"--junit", options.junit}});
  const auto recording = std::make_shared<const Recording>(read_recording(options.log));
  if (recording->is_truncated && !options.verify && !options.quiet)
    std::cerr << "warning: " << printable(options.log) << ": " << truncated_recording << "\n";

  Lab lab(*recording->start, KeepStart::No);
  lab.set_execution(make_execution(lab, {.threads = options.threads}));
  const Scene& scene = lab.scene();
  RunOutput output(options.output.files, options.log, scene, parse_points(options.output.points, scene.system.point_count()),
                   computed_by(lab.plan().execution));
  const RunRequest request{.sample = options.output.sample,
                           .accuracy = options.output.accuracy.value_or(output.needs_accuracy() ? AccuracyMode::Full : AccuracyMode::Off)};
  RunHooks hooks = output.hooks();
  RunTotals totals;
  catch_interrupts(lab);
  {
    ProgressBar progress(recording->frames, !options.quiet);
    hooks.progress = [&](long done, long) { progress.show(done); };
    totals = replay_frames(lab, recording, request, hooks);
  }
  output.finish(totals);

  const RunFiles& files = options.output.files;
  if (totals.interrupted) return report_interrupted("results", {files.json, files.csv}, scene.state.time);
  const bool is_same = lab.difference().empty(), is_cut = is_same && recording->is_truncated;
  const std::string failure = is_cut ? truncated_recording : lab.difference();
  if (options.junit) {
    OutputFile file(*options.junit);
    file.write(format_junit("hooke replay", {{.group = printable(options.log), .name = "every frame as recorded", .failure = failure}}));
    file.close();
  }
  if (!options.quiet && !options.output.writes_to_stdout() && options.junit != "-")
    std::cout << totals.frames << " frames to " << format_exact(scene.state.time) << " s, hash " << to_hexadecimal(totals.hash)
              << (options.verify && failure.empty() ? ": every frame as recorded\n" : "\n");
  if (failure.empty() || (is_cut && !options.verify)) return exit_code::success;
  std::cerr << (options.verify || totals.diverged ? "" : "warning: ") << printable(options.log) << ": " << failure
            << (totals.diverged || is_cut ? "\n" : "; what follows is the motion of this version\n");
  if (totals.diverged) return exit_code::diverged;
  return options.verify ? exit_code::check_failed : exit_code::success;
}

}  // namespace

std::function<int()> declare_replay(CLI::App& app) {
  auto options = std::make_shared<ReplayOptions>();
  app.add_option("LOG", options->log, "A recording (" + std::string(recording_extension) + ")")->required();
  app.add_flag("--verify", options->verify,
               "Exit with code 1 if a frame differs from the recorded one in any bit, or the last line is incomplete");
  app.add_option("--junit", options->junit, "Write as JUnit XML whether the frames are as recorded; - for stdout")->type_name("FILE");
  add_output_options(app, options->output, Summary::WithoutAccuracy);
  add_threads_option(app, options->threads);
  app.add_flag("-q,--quiet", options->quiet, "Print no warnings, progress or summary");
  return [options] { return replay(*options); };
}

}  // namespace hooke
