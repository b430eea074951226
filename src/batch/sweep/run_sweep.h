// Runs a parameter sweep, whole or in parts, and saves its table and charts: `hooke sweep`.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/shard.h"
#include "batch/sweep/sweep.h"
#include "batch/sweep/sweep_journal.h"

namespace hooke {

struct SweepRequest {
  Scene scene;
  Sweep sweep;  // made of the scene by make_sweep
  Shard shard{};
  // Resumes from the finished rows in it, appends each row as it is finished, and finally saves the table; none: nothing is written.
  std::optional<std::filesystem::path> folder{};
};

struct SweepHooks {
  std::function<bool()> should_continue = [] { return true; };  // called at the start and after every frame of each run
  std::function<void(long done, long all)> progress = [](long, long) {
  };  // at the start and after every run, without those found in the folder
};

struct SweepResults {
  Sweep sweep;
  SweepRows rows;  // finished, also by earlier calls
  bool is_complete() const { return rows.size() == sweep.row_count(); }
};

// Runs what is missing of the shard. Throws InputError if the folder contains another sweep, FileError.
SweepResults run_sweep(const SweepRequest& request, const SweepHooks& hooks);

// Merges the parts in these folders, and in `folder` if there is one, into `folder`. Throws InputError if they belong to different sweeps,
// FileError.
SweepResults merge_sweeps(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder);

// The first draws sweep.svg and sweep.png of a complete sweep with gnuplot and returns why there are none, if it cannot; the second creates
// the folder and writes sweep.csv and sweep.json. Throw FileError.
std::optional<std::string> draw_sweep_charts(const SweepResults& results, const std::filesystem::path& folder);
void save_sweep(const SweepResults& results, const std::filesystem::path& folder);

}  // namespace hooke
