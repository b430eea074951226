#include "cli/commands/bench_capacity.h"

#include <unistd.h>

#include <iostream>
#include <string>

#include "base/atomic_write.h"
#include "base/formatted.h"
#include "base/text_lines.h"
#include "batch/machine.h"
#include "batch/output_folder.h"
#include "cli/interrupt.h"
#include "cli/subcommand.h"
#include "study/capacity.h"

namespace hooke {
namespace {

std::string setting_of(const Capacity& capacity) {
  return capacity.setting.tolerance ? formatted("tolerance %.0e m", *capacity.setting.tolerance)
                                    : pluralize(static_cast<std::size_t>(capacity.substeps()), "substep", "substeps");
}

std::string table_row(const CapacityRow& row) {
  const std::string id(row.method->id);
  if (!row.largest) return formatted("| `%s` | none | | | | |\n", id.c_str());
  const Capacity& largest = *row.largest;
  return formatted("| `%s` | %s%d x %d | %ld | %s | %.1e | %.2f |\n", id.c_str(), row.is_bounded ? "" : "at least ", largest.n, largest.n,
                   largest.springs, setting_of(largest).c_str(), largest.relative_error, 1e3 * largest.frame_seconds);
}

std::string csv_row(const CapacityRow& row) {
  const std::string id(row.method->id);
  if (!row.largest) return id + ",0,0,,,,,1\n";
  const Capacity& largest = *row.largest;
  const std::string setting =
      largest.setting.tolerance ? formatted(",%.6g", *largest.setting.tolerance) : formatted("%d,", largest.substeps());
  return formatted("%s,%d,%ld,%s,%.6g,%.6g,%d\n", id.c_str(), largest.n * largest.n, largest.springs, setting.c_str(),
                   largest.relative_error, 1e3 * largest.frame_seconds, row.is_bounded ? 1 : 0);
}

}  // namespace

int bench_capacity(const std::filesystem::path& folder, std::span<const Integrator* const> methods, double relative_error, bool quick,
                   bool quiet) {
  make_folder(folder);
  catch_interrupts();
  const bool shows_progress = !quiet && isatty(STDERR_FILENO) != 0;
  const auto begin_size = [&](int n) {
    if (shows_progress) std::cerr << formatted("\rcloth %d x %d ...\x1b[K", n, n) << std::flush;
  };
  const CapacityResult result =
      measure_capacity(methods, capacity_sizes(quick), relative_error, quick ? 0.5 : 60.0, begin_size, [] { return !was_interrupted(); });
  if (shows_progress) std::cerr << "\r\x1b[K" << std::flush;
  if (was_interrupted()) return exit_interrupted();

  std::string csv = "method,points,springs,substeps,tolerance_m,relative_error,frame_ms,bounded\n";
  std::string table = formatted(
      "The largest cloth at %.0f frames per second, with an error of at most %.0e of its width, on one core of: %s\n\n"
      "| method | cloth | springs | per frame | error | ms per frame |\n|---|---|---|---|---|---|\n",
      capacity_frame_rate, relative_error, machine().c_str());
  for (const CapacityRow& row : result.rows) {
    csv += csv_row(row);
    table += table_row(row);
  }
  write_atomically(folder / "capacity.csv", csv);
  if (!quiet) std::cout << table;
  if (result.reason.empty()) return exit_code::success;
  std::cerr << formatted("No reference beyond %d x %d: ", result.largest_n, result.largest_n) << result.reason << "\n";
  return exit_code::check_failed;
}

}  // namespace hooke
