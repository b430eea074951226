// A parameter sweep: a scene run with every combination of values of some parameters, and the table of what is measured in each run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/parameters.h"
#include "scene/quantity.h"
#include "scene/scene.h"

namespace hooke {

inline constexpr std::size_t max_sweep_rows = 1'000'000;

// A parameter and the values that it takes, in the order of the table. None is repeated.
struct SweepAxis {
  const Parameter* parameter = nullptr;
  std::vector<double> values;
};

// A column of results. The CPU time of the run has no quantity.
struct SweepMeasure {
  enum class Of { End, Max, Min, Mean };  // the last state, or all states from the start to the end, one per frame
  std::string name;                       // as given, "max:y5"
  Of of = Of::End;
  std::optional<Quantity> quantity{};  // none: the CPU time [s], without what measuring the accuracy takes
  std::string unit() const { return quantity ? std::string(quantity->row->unit) : "s"; }
};

struct Sweep {
  std::string scene;              // its name
  std::uint64_t fingerprint = 0;  // of the scene as it was opened, with the options of the command
  double seconds = 0.0;           // [s], of each run
  std::vector<SweepAxis> axes;    // the last one varies fastest
  std::vector<SweepMeasure> measures;

  std::size_t row_count() const;
  // One value for each axis.
  std::vector<double> values_of(std::size_t row) const;
};

// Reads a sweep of a scene that was loaded from `name`. An axis is "stiffness=100:1e4:log:20", "substeps=8,16,32" or
// "damped_springs=on,off"; measures are "largest_strain,max:y5,cpu". Throws UsageError that names the option of the command, also for a
// parameter that the scene does not have.
Sweep make_sweep(const std::string& name, const Scene& scene, const std::vector<std::string>& axes, const std::string& measures,
                 double seconds);

// Of texts without a scene: return the reason if one is not valid, else an empty string.
std::string parse_axis(std::string_view text, SweepAxis& axis);
std::string parse_measures(std::string_view list, Index points, Index springs, std::vector<SweepMeasure>& measures);

// What --measure accepts, for messages.
std::string measure_names();

// The result of one run.
struct SweepRow {
  enum class Status { Ok, Warning, Diverged };
  std::size_t row = 0;
  Status status = Status::Ok;
  std::string note;                           // the warning, or why the run stopped
  std::vector<std::optional<double>> values;  // one for each measure; none: not known
  bool operator==(const SweepRow&) const = default;
};

// Runs one row on a copy of the scene. None if `should_continue`, called once per frame, returned false. Everything except the CPU time is
// the same in every process and on every machine.
std::optional<SweepRow> run_row(const Sweep& sweep, const Scene& scene, std::size_t row, const std::function<bool()>& should_continue);

}  // namespace hooke
