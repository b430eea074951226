// The output of `run`: samples as JSON and as CSV, written one by one and not kept in memory.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/json_writer.h"
#include "cli/output_file.h"
#include "scene/quantity.h"
#include "scene/scene.h"
#include "sim/energy.h"

namespace hooke {

// Totals of a finished run.
struct RunTotals {
  double seconds = 0.0;                          // simulated
  double cpu_seconds = 0.0, wall_seconds = 0.0;  // of the run, without measuring its accuracy
  double accuracy_cpu_seconds = 0.0;             // of that
  bool diverged = false;
  long force_evaluations = 0, factorizations = 0;
  std::uint64_t hash = 0;  // of the last state
};

// The JSON object of `run --json`. Unknown members are null.
class JsonReport {
 public:
  JsonReport(const std::string& file, const std::string& scene_name, const Scene& scene);
  void add_sample(const System& system, const State& state, const Accuracy& accuracy, const std::vector<Index>& points);
  void finish(const RunTotals& totals);

 private:
  OutputFile file_;
  JsonWriter json_;
};

// One row of quantities per sample.
class CsvReport {
 public:
  CsvReport(const std::string& file, std::vector<Quantity> quantities);
  void add_sample(const System& system, const State& state, const Accuracy& accuracy);
  void finish() { file_.close(); }
  // Whether any of the quantities does.
  bool needs_accuracy() const {
    return std::ranges::any_of(quantities_, [](const Quantity& each) { return each.row->needs_accuracy; });
  }

 private:
  OutputFile file_;
  std::vector<Quantity> quantities_;
};

// 16 hexadecimal digits.
std::string to_hexadecimal(std::uint64_t hash);

}  // namespace hooke
