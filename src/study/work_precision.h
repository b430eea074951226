// Work-precision data: the cost and the error of every method on every problem, from the coarsest stable setting to the finest that still
// reduces the error, measured against a converged reference.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/reference.h"

namespace hooke {

// One method at one setting on one problem.
struct Row {
  std::string method, setting;
  std::optional<double> step;       // [s]; none for an adaptive method
  std::optional<double> tolerance;  // [m], of such a method
  // none if the run did not finish
  std::optional<double> error;           // [m]
  std::optional<double> relative_error;  // [1]
  std::optional<double> energy_drift;    // [1]
  std::optional<double> strain_error;    // [1], if observables are compared
  std::optional<double> cpu_ms_per_s;    // CPU milliseconds per simulated second, the minimum of `runs`
  int runs = 0;
  WorkCounts work;
  std::string status;
  bool operator==(const Row&) const = default;
};

// The outcome of a run.
namespace status {
inline constexpr const char* ok = "ok";
inline constexpr const char* below_reference = "below_reference";  // error below the uncertainty of the reference
inline constexpr const char* unconverged = "unconverged";          // finished, but solves reached their iteration limit
inline constexpr const char* lost = "lost";                        // finished with an error larger than the scene
inline constexpr const char* diverged = "diverged";
inline constexpr const char* too_slow = "too_slow";    // abandoned
inline constexpr const char* too_large = "too_large";  // the factor of its matrix would need too much memory
}  // namespace status

// The reference in figures.
struct ReferenceRecord {
  std::string method, setting, other_method, other_setting;
  double own_gap = 0.0, other_own_gap = 0.0;  // [1], relative: change with half the precision
  double other_gap = 0.0;                     // [1], relative: between the two
  double amplification = 0.0;                 // [1]
  Measure measure = Measure::Trajectory;
  double uncertainty() const { return own_gap > other_gap ? own_gap : other_gap; }
};

// A problem and its rows, ordered by method as in the table of integrators, coarsest first.
struct ProblemRecord {
  std::string id, title;
  Index points = 0, springs = 0;
  double seconds = 0.0, size = 0.0;  // [s], [m]
  std::uint64_t fingerprint = 0;
  std::optional<ReferenceRecord> reference;
  std::vector<Row> rows;
};

ProblemRecord make_record(const Problem& problem);

// The place of a row in the table of integrators; that of other engines is after it.
std::ptrdiff_t method_index(const Row& row);

// Ends the names of methods that were measured on a device.
inline constexpr std::string_view on_device = " on GPU";

// Limits on the work.
struct Effort {
  int repeats = 5;                  // of a run; the minimum time counts
  double run_seconds = 4.0;         // CPU time beyond which no finer setting is tried
  double reference_seconds = 60.0;  // CPU time for each of the two solutions of a reference
  double finest_error = 1e-11;      // relative: no finer setting is tried below
};

// Fills the record of one problem, method by method. Existing rows are kept, and the reference is computed only if a new row needs it.
class PrecisionSweep {
 public:
  // All three must outlive it. `should_continue` is called often, `row_done` after every new row.
  PrecisionSweep(const Problem& problem, const Effort& effort, ProblemRecord& record);
  std::function<bool()> should_continue = [] { return true; };
  std::function<void()> row_done = [] {};

  // With a device, rows of "velocity_verlet on GPU", in real time, where it does not refuse the method. False when interrupted, or when the
  // problem has no reference.
  bool run(const Integrator& method, const std::shared_ptr<FrameDevice>& device = nullptr);
  ReferenceResult::Failure reference_failure() const { return reference_failure_; }
  const std::string& reference_failure_reason() const { return reference_failure_reason_; }

 private:
  std::string name_of(const Integrator& method) const { return std::string(method.id) + (device_ ? std::string(on_device) : ""); }
  const Row* measure(const Integrator& method, const Setting& setting);
  std::optional<Row> measure_row(const Integrator& method, const Setting& setting);
  bool ensure_reference();
  void sweep_coarser(const Integrator& method, Setting setting);
  void sweep_finer(const Integrator& method, Setting setting);

  const Problem& problem_;
  const Effort& effort_;
  ProblemRecord& record_;
  Benchmark benchmark_;
  std::shared_ptr<FrameDevice> device_;  // of the rows that are measured; null: the processor
  std::optional<Reference> reference_;
  ReferenceResult::Failure reference_failure_ = ReferenceResult::Failure::None;
  std::string reference_failure_reason_;
  bool stopped_ = false;
};

// The error, at least the uncertainty of the reference [1]; none if the run did not finish.
std::optional<double> error_with_uncertainty(const ProblemRecord& record, const Row& row);

// Whether the reference tells whether an error is as small as this.
bool is_measurable(const ProblemRecord& record, double relative_error);

// The cheapest row whose error is at most this, or null.
const Row* cheapest(const ProblemRecord& record, double relative_error);

// The rows that no other row beats in both error and cost, cheapest first.
std::vector<const Row*> pareto_front(const ProblemRecord& record);

}  // namespace hooke
