#include "cli/commands/commands.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "base/printable.h"
#include "base/text_lines.h"
#include "batch/sweep/run_sweep.h"
#include "cli/interrupt.h"
#include "cli/progress_bar.h"
#include "cli/scene_options.h"

namespace hooke {
namespace {

struct SweepOptions {
  std::shared_ptr<SceneOptions> scene;
  std::vector<std::string> vary;
  std::string measures;
  std::optional<double> seconds;  // [s]
  std::filesystem::path folder;
  std::string shard = "1/1";
  std::vector<std::filesystem::path> merge;  // folders of parts; empty: run
};

// The charts of a complete sweep, and how many runs diverged or had warnings; the table has the notes.
void report(const SweepResults& results, const SweepOptions& options) {
  if (results.is_complete())
    if (const std::optional<std::string> failure = draw_sweep_charts(results, options.folder)) std::cerr << *failure << "\n";
  if (options.scene->quiet) return;
  const auto count = [&](SweepRow::Status status) {
    return static_cast<std::size_t>(std::ranges::count_if(results.rows, [&](const auto& each) { return each.second.status == status; }));
  };
  const std::size_t diverged = count(SweepRow::Status::Diverged), warned = count(SweepRow::Status::Warning);
  std::cout << results.rows.size() << " of " << pluralize(results.sweep.row_count(), "run", "runs") << " in "
            << printable((options.folder / "sweep.csv").native()) << "\n";
  if (diverged > 0) std::cerr << "warning: " << pluralize(diverged, "run", "runs") << " diverged\n";
  if (warned > 0) std::cerr << "warning: " << pluralize(warned, "run has", "runs have") << " warnings\n";
}

int sweep(const SweepOptions& options) {
  for (const auto& [name, is_missing] : {std::pair{"SCENE", options.scene->scene.empty()},
                                         {"--vary", options.vary.empty()},
                                         {"--measure", options.measures.empty()},
                                         {"--seconds", !options.seconds.has_value()}})
    if (is_missing) throw UsageError(std::string(name) + " is required");
  SweepRequest request{.scene = {}, .sweep = {}, .shard = parse_shard(options.shard), .folder = options.folder};
  request.scene = open_scene(*options.scene);
  request.sweep = make_sweep(options.scene->scene, request.scene, options.vary, options.measures, *options.seconds);

  catch_interrupts();
  std::optional<ProgressBar> progress;
  SweepHooks hooks;
  hooks.should_continue = [] { return !was_interrupted(); };
  hooks.progress = [&](long done, long all) {
    if (!progress) progress.emplace(all, !options.scene->quiet);
    progress->show(done);
  };
  const SweepResults results = run_sweep(request, hooks);
  progress.reset();
  report(results, options);
  if (!was_interrupted()) return exit_code::success;
  std::cerr << "Interrupted; results so far are saved. The same command resumes from them.\n";
  return exit_interrupted();
}

int merge_parts(const SweepOptions& options) {
  const SweepResults results = merge_sweeps(options.merge, options.folder);
  report(results, options);
  if (results.is_complete()) return exit_code::success;
  std::size_t first = 0;
  while (results.rows.contains(first)) ++first;
  const std::size_t rows = results.sweep.row_count();
  std::cerr << "incomplete: " << rows - results.rows.size() << " of " << rows << " runs are missing, the first is row " << first << "\n";
  return exit_code::check_failed;
}

}  // namespace

std::function<int()> declare_sweep(CLI::App& app) {
  auto options = std::make_shared<SweepOptions>();
  options->scene = add_scene_options(app, SceneIs::Optional);
  add_import_options(app, options->scene->import);
  app.add_option(
         "--vary", options->vary,
         "A parameter and its values, as a list or as MIN:MAX:log:COUNT or MIN:MAX:lin:COUNT; may be repeated: every combination is "
         "run. Parameters: those of --set")
      ->type_name("NAME=VALUES")
      ->expected(1)
      ->take_all();
  app.add_option("--measure", options->measures, "Columns of the table, comma-separated: " + measure_names())->type_name("NAME,...");
  app.add_option("--seconds", options->seconds, "Simulated time of each run, rounded up to whole frames [s]")
      ->type_name("S")
      ->transform(within(not_negative));
  app.add_option("--out", options->folder,
                 "Folder for sweep.csv, .json, .svg, .png, and sweep.jsonl, which has a line for each finished run and from which an "
                 "interrupted sweep resumes")
      ->type_name("DIR")
      ->required();
  add_shard_option(app, options->shard);
  CLI::Option* merge =
      app.add_option("--merge", options->merge, "Write one table of the parts in these folders instead of running anything")
          ->type_name("DIR");
  for (const char* other :
       {"--vary", "--measure", "--seconds", "--shard", "SCENE", "--integrator", "--substeps", "--frame-rate", "--tolerance", "--set"})
    merge->excludes(other);
  return [options] { return options->merge.empty() ? sweep(*options) : merge_parts(*options); };
}

}  // namespace hooke
