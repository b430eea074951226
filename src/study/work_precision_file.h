// Benchmark results on disk: bench.json, from which an interrupted benchmark resumes, and bench.csv.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.h"
#include "study/work_precision.h"

namespace hooke {

// The conditions of a measurement besides the scene: results under different conditions are not mixed.
struct Conditions {
  std::string version;  // of the program
  std::string build;    // a fingerprint of the executable
  std::string machine;  // its processor
  std::string effort;   // "full", "quick"
  bool operator==(const Conditions&) const = default;
};

inline constexpr std::size_t max_part_records = 1'000'000;

// A part of a benchmark that is divided among processes.
struct PartRecord {
  std::string of;                     // the scenes and the methods of the whole
  std::size_t number = 1, count = 1;  // from 1 to count
  bool is_complete = false;           // false: it was interrupted
  bool is_same(const PartRecord& other) const { return of == other.of && number == other.number && count == other.count; }
};

struct Results {
  Conditions conditions;
  std::string date;               // ISO 8601, of the last row
  std::vector<PartRecord> parts;  // that were measured; empty: not known
  std::vector<ProblemRecord> problems;
};

// JSON; an unknown number is null.
std::string format_results(const Results& results);

// Throws InputError if the text does not contain benchmark results; `name` is the file in messages.
Results parse_results(const std::string& text, const std::string& name);

// One line per row, below a line with the names of the columns: scene, method, setting, step_s, error_m, relative_error, cpu_ms_per_s,
// force_evaluations, factorizations, energy_drift, status. Empty if a number is unknown.
std::string format_csv(const Results& results);

}  // namespace hooke
