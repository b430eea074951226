#include "cli/commands/bench_scaling.h"

#include <iostream>
#include <string>

#include "base/atomic_write.h"
#include "base/formatted.h"
#include "batch/machine.h"
#include "batch/output_folder.h"
#include "batch/scaling.h"
#include "cli/interrupt.h"
#include "cli/subcommand.h"

namespace hooke {

int bench_scaling(const std::filesystem::path& folder, bool quick, bool quiet) {
  make_folder(folder);
  catch_interrupts();
  std::string csv = "points,springs,step_ms,ns_per_spring,peak_mib,bytes_per_spring\n";
  if (!quiet)
    std::cout
        << "velocity_verlet, double precision, one thread of: " << machine() << "\n\n"
        << "| cloth | springs | ms per step | ns per spring and step | peak memory [MiB] | bytes per spring |\n|---|---|---|---|---|---|\n";
  std::vector<ScalingRow> rows;
  for (const int n : scaling_sizes(quick)) {
    if (was_interrupted()) return exit_interrupted();
    const ScalingRow row = rows.emplace_back(measure_scaling(n));
    const double mib = row.peak_bytes / (1 << 20);
    append_formatted(csv, "%d,%ld,%.6g,%.4g,%.4g,%.4g\n", n * n, row.springs, row.step_ms, row.ns_per_spring(), mib,
                     row.bytes_per_spring());
    if (!quiet)
      std::cout << formatted("| %d x %d | %ld | %.4g | %.3g | %.1f | %.0f |\n", n, n, row.springs, row.step_ms, row.ns_per_spring(), mib,
                             row.bytes_per_spring())
                << std::flush;
  }
  write_atomically(folder / "scaling.csv", csv);
  if (!quiet) std::cout << formatted("\nslope of log(time) over log(springs): %.3f\n", scaling_slope(rows));
  return exit_code::success;
}

}  // namespace hooke
