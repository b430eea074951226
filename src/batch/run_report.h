// The output of `run`: samples as JSON and as CSV, written one by one and not kept in memory.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/json_writer.h"
#include "batch/output_file.h"
#include "batch/run_frames.h"
#include "formats/point_cache.h"
#include "scene/quantity.h"
#include "scene/scene.h"
#include "sim/forces/energy/energy.h"
#include "sim/plan/execution.h"

namespace hooke {

// What computes the frames: "double" or "single"; "cpu", "gpu" or the command of an engine.
struct ComputedBy {
  std::string precision = "double", device = "cpu";
};
ComputedBy computed_by(const Execution& execution);

// The JSON object of `run --json`. Unknown members are null.
class JsonReport {
 public:
  JsonReport(const std::string& file, const std::string& scene_name, const Scene& scene, const ComputedBy& by);
  // `points`: none: all. What is not in the scene at that time is null.
  void add_sample(const System& system, const State& state, const Accuracy& accuracy, const std::optional<std::vector<Index>>& points);
  void finish(const RunTotals& totals);

 private:
  OutputFile file_;
  JsonWriter json_;
  double allowed_error_ = 0.0;  // [m], in a frame, with `auto`
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

// The files that a run writes; "-" is stdout.
struct RunFiles {
  std::optional<std::string> json, csv, pc2;
  std::optional<std::string> quantities;  // columns of the CSV file, "time,y5"; none: time, energies, positions of the points
};

// "0,5,9", of a scene with so many points; none: all of them. Throws UsageError.
std::optional<std::vector<Index>> parse_points(const std::optional<std::string>& list, Index count);

// Writes the files of a run. All members throw FileError.
class RunOutput {
 public:
  // Opens the files for samples of these points; none: all. The scene must outlive it. Throws UsageError for an unknown quantity.
  RunOutput(const RunFiles& files, const std::string& scene_name, const Scene& scene, const std::optional<std::vector<Index>>& points,
            const ComputedBy& by);
  // Whether the files contain errors; whether a chosen quantity is one, which is then not null only if they are measured.
  bool needs_accuracy() const { return json_ || has_chosen_errors(); }
  bool has_chosen_errors() const { return csv_ && has_chosen_quantities_ && csv_->needs_accuracy(); }
  // What the files represent only coarsely.
  std::optional<std::string> warning() const { return pc2_ ? point_cache_warning(scene_.state) : std::nullopt; }
  // Writes samples and frames; must not outlive this object.
  RunHooks hooks();
  void finish(const RunTotals& totals);

 private:
  const Scene& scene_;
  std::optional<std::vector<Index>> points_;
  bool has_chosen_quantities_;
  std::optional<JsonReport> json_;
  std::optional<CsvReport> csv_;
  std::optional<PointCacheWriter> pc2_;
};

// 16 hexadecimal digits.
std::string to_hexadecimal(std::uint64_t hash);

}  // namespace hooke
