#include "cli/commands/bench.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "base/atomic_write.h"
#include "base/build_info.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "cli/commands/bench_progress.h"
#include "cli/commands/bench_report.h"
#include "cli/commands/methods_page.h"
#include "cli/commands/run_report.h"
#include "cli/gnuplot.h"
#include "cli/interrupt.h"
#include "cli/machine.h"
#include "formats/scene_file.h"
#include "sim/hash.h"
#include "study/work_precision_chart.h"

namespace hooke {
namespace {

struct BenchOptions {
  std::vector<std::string> scenes;   // built-in problems, shipped scenes or files; empty: the built-in problems
  std::vector<std::string> methods;  // ids; empty: all
  std::filesystem::path folder = ".";
  std::filesystem::path report_of;  // results to write a report of, without measuring
  bool quick = false, quiet = false;
};

// A quick benchmark ends within a minute on any machine: it is coarser, and cut short if necessary.
constexpr Effort quick_effort{.repeats = 3, .run_seconds = 0.04, .reference_seconds = 0.5, .finest_error = 1e-10};
constexpr std::chrono::seconds quick_limit{50};

// Hash of the program file: figures of different builds are not mixed.
std::string build() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(program), {});
  return to_hexadecimal(hash_bytes(bytes));
}

std::vector<Problem> chosen_problems(const BenchOptions& options) {
  std::vector<Problem> chosen;
  if (options.scenes.empty())
    for (const BuiltInProblem& row : built_in_problems())
      if (row.quick || !options.quick) chosen.push_back(row.make());
  for (const std::string& name : options.scenes)
    if (const BuiltInProblem* row = find_problem(name))
      chosen.push_back(row->make());
    else
      chosen.push_back(make_problem(printable(std::filesystem::path(name).stem().native(), 80), load_scene(find_scene(name)).scene));
  return chosen;
}

// In the order of the table.
std::vector<const Integrator*> chosen_methods(const std::vector<std::string>& ids) {
  for (const std::string& id : ids)
    if (find_integrator(id) == nullptr) throw UsageError("--methods: " + printable(id, 80) + ": no such method");
  std::vector<const Integrator*> chosen;
  for (const Integrator& method : integrators())
    if (ids.empty() || std::find(ids.begin(), ids.end(), method.id) != ids.end()) chosen.push_back(&method);
  return chosen;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw FileError(printable(folder.native()) + ": cannot be created: " + failure.message());
}

void write_pages(const Results& results, const std::filesystem::path& folder) {
  write_atomically(folder / "bench.md", markdown_report(results));
  write_atomically(folder / "methods.md", methods_page(results));
}

void draw_charts(const Results& results, const std::filesystem::path& folder) {
  for (const auto& [format, file] : {std::pair{ChartFormat::Svg, "bench.svg"}, std::pair{ChartFormat::Png, "bench.png"}})
    if (const std::optional<std::string> failure = run_gnuplot(chart_script(results, format, file), folder)) {
      std::cerr << *failure << "\n";
      return;
    }
}

int rewrite_report(const BenchOptions& options) {
  make_folder(options.folder);
  const Results results = parse_results(read_file(options.report_of), printable(options.report_of.native()));
  write_pages(results, options.folder);
  draw_charts(results, options.folder);
  if (!options.quiet)
    for (const ProblemRecord& record : results.problems) std::cout << report(record);
  return exit_code::success;
}

// One benchmark and its folder.
class Bench {
 public:
  explicit Bench(const BenchOptions& options)
      : options_(options),
        effort_(options.quick ? quick_effort : Effort{}),
        problems_(chosen_problems(options)),
        methods_(chosen_methods(options.methods)),
        progress_(problems_.size() * methods_.size(), !options.quiet) {
    make_folder(options_.folder);
    load_earlier_results();
  }

  int run() {
    catch_interrupts();
    for (const Problem& problem : problems_) {
      if (!should_continue()) break;
      measure(problem);
    }
    progress_.clear();
    draw_charts(results_, options_.folder);

    if (!options_.quiet)
      for (const ProblemRecord& record : results_.problems) std::cout << report(record);
    if (was_interrupted()) {
      std::cerr << "Interrupted. Results so far are saved; the same command resumes from them.\n";
      return exit_interrupted;
    }
    if (!should_continue()) std::cerr << "Time limit of --quick reached. Results so far are saved; the same command resumes from them.\n";
    return exit_code_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool should_continue() const { return !was_interrupted() && !(options_.quick && Clock::now() - start_ > quick_limit); }

  // Rows measured under the same conditions are not measured again.
  void load_earlier_results() {
    results_.conditions = {program_version, build(), machine(), options_.quick ? "quick" : "full"};
    const std::filesystem::path file = options_.folder / "bench.json";
    if (!std::filesystem::exists(file)) return;
    Results earlier = parse_results(read_file(file), printable(file.native()));
    if (earlier.conditions == results_.conditions)
      results_ = std::move(earlier);
    else if (!options_.quiet)
      std::cerr << printable(file.native()) << ": from another build, machine or effort; measuring again\n";
  }

  ProblemRecord& find_or_add_record(const Problem& problem) {
    for (ProblemRecord& record : results_.problems)
      if (record.id == problem.id) {
        if (record.fingerprint != fingerprint(problem)) record = make_record(problem);
        return record;
      }
    return results_.problems.emplace_back(make_record(problem));
  }

  void measure(const Problem& problem) {
    ProblemRecord& record = find_or_add_record(problem);
    PrecisionSweep sweep(problem, effort_, record);
    sweep.should_continue = [this] { return should_continue(); };
    sweep.row_done = [&] { progress_.show(record.rows.back().setting); };
    for (const Integrator* method : methods_) {
      progress_.begin_part(problem.id + "  " + std::string(method->id));
      const std::size_t rows = record.rows.size();
      const bool finished = sweep.run(*method);
      const bool is_new = record.rows.size() > rows;
      progress_.end_part(is_new);
      if (is_new) save();
      if (!finished) break;
    }
    using enum ReferenceResult::Failure;
    if (sweep.reference_failure() != NotFinished && sweep.reference_failure() != Disagreement) return;
    progress_.clear();
    std::cerr << problem.id << ": no reference, nothing measured: " << sweep.reference_failure_reason() << "\n";
    exit_code_ = exit_code::check_failed;
  }

  void save() {
    results_.date = time_text("%Y-%m-%dT%H:%M:%SZ");
    write_atomically(options_.folder / "bench.json", format_results(results_));
    write_atomically(options_.folder / "bench.csv", format_csv(results_));
    write_pages(results_, options_.folder);
  }

  const BenchOptions& options_;
  const Effort effort_;
  const std::vector<Problem> problems_;
  const std::vector<const Integrator*> methods_;
  BenchProgress progress_;
  Results results_;
  int exit_code_ = exit_code::success;
  const Clock::time_point start_ = Clock::now();
};

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
  app.add_option("--report", options->report_of, "Write the tables and charts of these results to DIR again, without measuring")
      ->type_name("bench.json");
  app.add_flag("--quick", options->quick, "Fewer problems, coarser, in at most a minute");
  app.add_flag("-q,--quiet", options->quiet, "Print neither report nor progress");
  return [options] { return options->report_of.empty() ? Bench(*options).run() : rewrite_report(*options); };
}

}  // namespace hooke
