// Cost against error of every method on a scene as it is now: what the chart "Compare methods" shows.
#pragma once

#include <filesystem>

#include "base/progress.h"
#include "sim/model/settings.h"
#include "study/work_precision.h"

namespace hooke {

struct MethodComparison {
  ProblemRecord record;  // its rows are empty if there is no reference, or when stopped before the first
  std::string note;      // in a sentence: why the compared time is shorter than wanted, or why there is no result; empty: neither
};

// Runs all methods from this state, each at several settings, for `seconds` [s] at this frame rate [1/s], 0: that of a benchmark, or, if
// the motion cannot be predicted for that long, for a shorter time. `progress` is called often, with the part done; false ends it with the
// rows so far.
MethodComparison compare_methods(const System& system, const State& state, double seconds, const Effort& effort, const Progress& progress,
                                 double frame_rate = 0.0);

// A comparison that takes some ten seconds for a small scene.
inline constexpr Effort comparison_effort{.repeats = 2, .run_seconds = 0.4, .reference_seconds = 3.0, .finest_error = 1e-10};

// The substeps of a frame that take at most the step of this row; none for an adaptive method.
std::optional<int> substeps_of(const Row& row, double frame_rate);

// Writes a comparison to a file, in the formats of `hooke bench`, by its extension: .csv and .json values, .svg and .png the chart, which
// needs gnuplot. Returns the reason in one line if it cannot be written, else an empty string.
std::string write_comparison(const MethodComparison& comparison, const std::filesystem::path& file);

}  // namespace hooke
