// The options of the files with samples, common to the commands that write them.
#pragma once

#include <optional>
#include <string>

#include "batch/run_report.h"
#include "cli/subcommand.h"
#include "lab/accuracy/accuracy_meter.h"

namespace hooke {

struct OutputOptions {
  std::optional<double> sample;       // [s]
  std::optional<std::string> points;  // "0,5,9"; none: all
  RunFiles files;
  std::optional<AccuracyMode> accuracy;  // none: full if an output contains it

  bool writes_to_stdout() const { return files.json == "-" || files.csv == "-"; }
};

// Declares --sample, --points, --json, --csv, --quantities and --accuracy.
enum class Summary { WithoutAccuracy, WithErrorOfFrame };
void add_output_options(CLI::App& app, OutputOptions& options, Summary summary);

}  // namespace hooke
