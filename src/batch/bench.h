// Measures speed against error of methods on scenes: `hooke bench`, and `bench` of the Python module.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/shard.h"
#include "study/work_precision_file.h"

namespace hooke {

// A quick benchmark ends within a minute on any machine: it is coarser, and cut short if necessary.
inline constexpr Effort quick_effort{.repeats = 3, .run_seconds = 0.04, .reference_seconds = 0.5, .finest_error = 1e-10};
inline constexpr std::chrono::seconds quick_limit{50};

struct BenchRequest {
  std::vector<Problem> problems;
  std::vector<const Integrator*> methods;
  Effort effort{};
  std::string effort_name = "full";
  std::optional<std::chrono::seconds> limit{};
  std::shared_ptr<FrameDevice> device{};  // measures the methods that run there on it, too; null: none
  Shard shard{};                                  // of the pairs of a problem and a method
  std::optional<std::filesystem::path> folder{};  // resumes from the results in it and saves after every method; none: nothing is written
};

struct BenchHooks {
  std::function<bool()> should_continue = [] { return true; };                   // called often
  std::function<void(const std::string& part)> begin_part = [](const auto&) {};  // one method on one problem
  std::function<void(const std::string& setting)> row_done = [](const auto&) {};
  std::function<void(bool was_measured)> end_part = [](bool) {};              // false: found in earlier results
  std::function<void(const std::string& line)> note = [](const auto&) {};     // earlier results are not used
  std::function<void(const std::string& line)> failure = [](const auto&) {};  // a problem without a reference
};

struct BenchResults {
  Results results;
  bool is_complete = true;  // false: ended by should_continue or the time limit
  bool has_failed = false;  // a problem has no reference
};

// Throws InputError, FileError.
BenchResults run_bench(const BenchRequest& request, const BenchHooks& hooks);

// The results in these folders together, and what is missing. Throws InputError if they were measured under different conditions,
// FileError.
MergedResults merge_benches(const std::vector<std::filesystem::path>& folders);

// The built-in problems, for quick ones only those that are fast.
std::vector<Problem> default_problems(bool quick);
// A built-in problem, or one second of a shipped scene or file. Throws InputError, FileError.
Problem problem_named(const std::string& name);
// The methods with these ids in the order of the table; all if there are none. Throws UsageError.
std::vector<const Integrator*> chosen_methods(const std::vector<std::string>& ids);

// Creates the folder and writes bench.json, bench.csv, bench.md and methods.md; the second draws bench.svg and bench.png with gnuplot and
// returns why there are none, if it cannot. Throws FileError.
void save_results(const Results& results, const std::filesystem::path& folder);
void write_pages(const Results& results, const std::filesystem::path& folder);
std::optional<std::string> draw_charts(const Results& results, const std::filesystem::path& folder);

}  // namespace hooke
