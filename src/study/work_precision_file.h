// A benchmark's results on disk: bench.json, which an interrupted benchmark goes on from, and bench.csv.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.h"
#include "study/work_precision.h"

namespace hooke {

// What figures depend on besides the scene: results made under other conditions are not mixed with new ones.
struct Conditions {
  std::string version;  // of the program
  std::string build;    // a fingerprint of the executable
  std::string machine;  // its processor
  std::string effort;   // "full", "quick"
  bool operator==(const Conditions&) const = default;
};

struct Results {
  Conditions conditions;
  std::string date;  // ISO 8601, of the last row
  std::vector<ProblemRecord> problems;
};

// JSON; a number that is not known is null.
std::string format_results(const Results& results);

// Throws InputError when the text is no benchmark's results; `name` stands for the file in messages.
Results parse_results(const std::string& text, const std::string& name);

// One line a row, under a line with the names of the columns: scene, method, setting, step_s, error_m, relative_error,
// cpu_ms_per_s, force_evaluations, factorizations, energy_drift, status. Empty where a number is not known.
std::string format_csv(const Results& results);

}  // namespace hooke
