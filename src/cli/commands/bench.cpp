#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/formatted.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "batch/bench.h"
#include "batch/bench_report.h"
#include "batch/junit.h"
#include "batch/output_file.h"
#include "cli/commands/bench_tables.h"
#include "cli/commands/commands.h"
#include "cli/interrupt.h"
#include "cli/scene_options.h"
#include "device/gpu_device.h"
#include "sim/control/automatic.h"
#include "study/work_precision_file.h"

namespace hooke {
namespace {

// Progress of a benchmark, on one line of a terminal. A part is one method on one problem.
class BenchProgress {
 public:
  // Shows nothing unless `enabled` and stderr is a terminal.
  BenchProgress(std::size_t parts, bool enabled) : parts_(parts), enabled_(enabled && isatty(STDERR_FILENO) == 1) {}
  ~BenchProgress() { clear(); }
  BenchProgress(const BenchProgress&) = delete;
  BenchProgress& operator=(const BenchProgress&) = delete;

  void begin_part(const std::string& label) {
    ++started_;
    label_ = label;
    part_start_ = Clock::now();
    show("");
  }

  void show(const std::string& detail) const {
    if (enabled_)
      std::fprintf(stderr, "\r\033[K%zu of %zu%s: %s  %s", started_, parts_, time_left().c_str(), label_.c_str(), detail.c_str());
  }

  // A part found in earlier results is excluded from the estimate of the time left.
  void end_part(bool was_measured) {
    if (!was_measured) return;
    ++measured_;
    spent_ += Clock::now() - part_start_;
  }

  // Clears its line.
  void clear() const {
    if (enabled_) std::fputs("\r\033[K", stderr);
  }

 private:
  // from the mean time of the parts measured so far
  std::string time_left() const {
    if (measured_ == 0) return "";
    const double each = std::chrono::duration<double>(spent_).count() / static_cast<double>(measured_);
    const double seconds = each * static_cast<double>(parts_ + 1 - started_);
    return seconds < 90.0 ? formatted(", %.0f s left", seconds) : formatted(", %.0f min left", seconds / 60.0);
  }

  using Clock = std::chrono::steady_clock;
  std::size_t parts_, started_ = 0, measured_ = 0;
  bool enabled_;
  std::string label_;
  Clock::time_point part_start_ = Clock::now();
  Clock::duration spent_{};
};

// Larger than the differences between references that were refined differently, smaller than those between settings.
constexpr double allowed_growth = 1.1;  // [1]

std::string failure_of(const ProblemRecord& earlier_record, const Row& earlier, const ProblemRecord& record, const Row& now) {
  const std::optional<double> before = error_with_uncertainty(earlier_record, earlier), after = error_with_uncertainty(record, now);
  if (!before) return "";
  if (!after) return formatted("%s; the error was %.3g", now.status.c_str(), *before);
  return *after <= allowed_growth * *before ? "" : formatted("error %.3g of the size, %.3g in the earlier results", *after, *before);
}

// Against earlier results: one case for each problem, method and setting of both. It failed if its error is more than 10 % larger, beyond
// the uncertainty of the reference, or if the run did not finish although the earlier one did. Times depend on the machine.
std::vector<JunitCase> compare_with_earlier(const Results& earlier, const Results& now) {
  std::vector<JunitCase> cases;
  for (const ProblemRecord& record : now.problems) {
    const auto same = std::ranges::find(earlier.problems, record.id, &ProblemRecord::id);
    if (same == earlier.problems.end()) continue;
    for (const Row& row : record.rows) {
      const auto matches = [&](const Row& other) { return other.method == row.method && other.setting == row.setting; };
      if (const auto other = std::ranges::find_if(same->rows, matches); other != same->rows.end())
        cases.push_back({.group = record.id, .name = row.method + ", " + row.setting, .failure = failure_of(*same, *other, record, row)});
    }
  }
  return cases;
}

struct BenchOptions {
  std::vector<std::string> scenes;   // built-in problems, shipped scenes or files; empty: the built-in problems
  std::vector<std::string> methods;  // ids; empty: all
  std::filesystem::path folder = ".";
  std::filesystem::path report_of;  // results to write a report of, without measuring
  std::filesystem::path verify;     // earlier results to compare with; empty: none
  std::optional<std::string> junit;
  Device device = Device::Cpu;
  bool quick = false, quiet = false, scaling = false, kernels = false, edits = false, capacity = false, overhead = false;
  double error = 1e-3;  // [1], of the cloths of --capacity, relative to their width
  std::string shard = "1/1";
  std::vector<std::filesystem::path> merge;  // folders of parts; empty: measure
};

void draw_and_print(const Results& results, const BenchOptions& options) {
  if (results.problems.empty()) return;
  if (const std::optional<std::string> failure = draw_charts(results, options.folder)) std::cerr << *failure << "\n";
  if (options.quiet || options.junit == "-") return;
  for (const ProblemRecord& record : results.problems) std::cout << report(record);
}

int rewrite_report(const BenchOptions& options) {
  make_folder(options.folder);
  const Results results = parse_results(read_file(options.report_of), printable(options.report_of.native()));
  write_pages(results, options.folder);
  draw_and_print(results, options);
  return exit_code::success;
}

int merge_parts(const BenchOptions& options) {
  const auto [results, missing] = merge_benches(options.merge);
  save_results(results, options.folder);
  draw_and_print(results, options);
  if (missing.empty()) return exit_code::success;
  std::cerr << "incomplete: " << missing << "\n";
  return exit_code::check_failed;
}

BenchRequest request_of(const BenchOptions& options) {
  BenchRequest request{.problems = options.scenes.empty() ? default_problems(options.quick) : std::vector<Problem>(),
                       .methods = {},
                       .effort = options.quick ? quick_effort : Effort{},
                       .effort_name = options.quick ? "quick" : "full",
                       .shard = parse_shard(options.shard),
                       .folder = options.folder};
  for (const std::string& name : options.scenes) request.problems.push_back(problem_named(name));
  request.methods = chosen_methods(options.methods);
  if (options.quick) request.limit = quick_limit;
  if (options.device == Device::Gpu) request.device = open_gpu();
  if (!options.quiet) print_device({.device = request.device});
  return request;
}

// Whether no error is larger than in the earlier results.
bool is_as_accurate(const Results& earlier, const Results& now, const BenchOptions& options) {
  const std::vector<JunitCase> cases = compare_with_earlier(earlier, now);
  if (cases.empty()) throw InputError(printable(options.verify.native()) + ": has no problem, method and setting that was measured now");
  for (const JunitCase& each : cases)
    if (!each.failure.empty()) std::cerr << each.group << ", " << each.name << ": " << each.failure << "\n";
  if (options.junit) {
    OutputFile file(*options.junit);
    file.write(format_junit("hooke bench", cases));
    file.close();
  }
  return std::ranges::all_of(cases, &std::string::empty, &JunitCase::failure);
}

int bench(const BenchOptions& options) {
  std::optional<Results> earlier;
  if (!options.verify.empty()) earlier = parse_results(read_file(options.verify), printable(options.verify.native()));
  const BenchRequest request = request_of(options);
  BenchProgress progress(request.shard.count_of(request.problems.size() * request.methods.size()), !options.quiet);
  bool is_interrupted = false;
  BenchHooks hooks;
  hooks.should_continue = [&] { return !(is_interrupted = was_interrupted()); };
  hooks.begin_part = [&](const std::string& part) { progress.begin_part(part); };
  hooks.row_done = [&](const std::string& setting) { progress.show(setting); };
  hooks.end_part = [&](bool was_measured) { progress.end_part(was_measured); };
  hooks.note = [&](const std::string& line) {
    if (!options.quiet) std::cerr << line << "\n";
  };
  hooks.failure = [&](const std::string& line) {
    progress.clear();
    std::cerr << line << "\n";
  };

  catch_interrupts();
  const BenchResults results = run_bench(request, hooks);
  progress.clear();
  draw_and_print(results.results, options);
  if (is_interrupted) {
    std::cerr << "Interrupted; results so far are saved. The same command resumes from them.\n";
    return exit_interrupted();
  }
  if (!results.is_complete) std::cerr << "Time limit of --quick reached; results so far are saved. The same command resumes from them.\n";
  const bool is_worse = earlier && !is_as_accurate(*earlier, results.results, options);
  return results.has_failed || is_worse ? exit_code::check_failed : exit_code::success;
}

// What is done instead of measuring the scenes, one at a time.
std::vector<CLI::Option*> add_other_measurements(CLI::App& app, BenchOptions& options) {
  return {app.add_option("--report", options.report_of, "Write the tables and charts of these results to DIR again, without measuring")
              ->type_name("bench.json"),
          app.add_option("--merge", options.merge, "Write one table of the parts in these folders, without measuring")->type_name("DIR"),
          app.add_flag("--scaling", options.scaling,
                       "Measure the time and the memory of cloths of 1e3 to 4e6 springs instead, and write them to scaling.csv"),
          app.add_flag("--kernels", options.kernels,
                       "Measure the time of a step of several kinds of cloth instead, and write it to kernels.csv"),
          app.add_flag("--edits", options.edits,
                       "Measure the time from edits of running cloths to their pictures instead, and write it to edits.csv"),
          app.add_flag("--capacity", options.capacity,
                       "Measure the largest cloth that each method steps at 60 frames per second within --error instead, and write it to "
                       "capacity.csv"),
          app.add_flag(
              "--overhead", options.overhead,
              "Measure the overhead of the error of a frame and of the energy balance instead, for each method and auto on SCENE or some "
              "shipped scenes, and write it to overhead.csv")};
}

}  // namespace

std::function<int()> declare_bench(CLI::App& app) {
  auto options = std::make_shared<BenchOptions>();
  std::string built_in;
  for (const BuiltInProblem& row : built_in_problems()) built_in += (built_in.empty() ? "" : " ") + std::string(row.id);
  app.add_option("SCENE", options->scenes, "Built-in problems, shipped scenes or scene files, one second of each; default: " + built_in);
  app.add_option("--methods", options->methods, "Only these methods, comma-separated")->delimiter(',')->type_name("ID,...");
  app.add_option("--out", options->folder, "Folder for bench.json, .csv, .md, .svg, .png and methods.md; resumes from existing results")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_flag("--quick", options->quick, "Fewer problems, coarser, in at most a minute");
  app.add_flag("-q,--quiet", options->quiet, "Print neither report nor progress");
  add_shard_option(app, options->shard);
  CLI::Option* verify = app.add_option("--verify", options->verify,
                                       "Exit with code 1 if an error is more than 10 % larger than in these results, or a run fails "
                                       "that finished")
                            ->type_name("bench.json");
  app.add_option("--junit", options->junit, "With --verify: write the comparison as JUnit XML; - for stdout")
      ->type_name("FILE")
      ->needs(verify);
  const std::vector<CLI::Option*> instead = add_other_measurements(app, *options);
  CLI::Option* error = app.add_option("--error", options->error, "With --capacity: RMS error of the positions, relative to the width")
                           ->transform(within({1e-9, 0.1}))
                           ->type_name("E")
                           ->capture_default_str();
  error->needs("--capacity");
  CLI::Option* device = app.add_option("--device", options->device,
                                       "gpu: also measure the methods that run on the GPU, in real time; with --kernels, on the GPU alone")
                            ->type_name("cpu|gpu")
                            ->transform(one_of({"cpu", "gpu"}));
  for (CLI::Option* option : instead) {
    const bool is_overhead = option == instead.back(), is_capacity = option == instead[instead.size() - 2];
    if (!is_overhead) option->excludes("SCENE");
    if (!is_overhead && !is_capacity) option->excludes("--methods");
    option->excludes("--shard");
    if (option->get_name() != "--kernels") option->excludes(device);
    option->excludes(verify);
    for (CLI::Option* other : instead)
      if (other != option) option->excludes(other);
  }
  return [options] {
    if (options->capacity)
      return bench_capacity(options->folder, chosen_methods(options->methods), options->error, options->quick, options->quiet);
    if (options->overhead) {
      std::vector<const Integrator*> methods = chosen_methods(options->methods);
      if (options->methods.empty()) methods.push_back(&automatic_method());
      return bench_overhead(options->folder, options->scenes, methods, options->quick, options->quiet);
    }
    if (options->kernels) return bench_kernels(options->folder, options->device, options->quick, options->quiet);
    if (options->edits) return bench_edits(options->folder, options->quick, options->quiet);
    if (options->scaling) return bench_scaling(options->folder, options->quick, options->quiet);
    if (!options->merge.empty()) return merge_parts(*options);
    return options->report_of.empty() ? bench(*options) : rewrite_report(*options);
  };
}

}  // namespace hooke
