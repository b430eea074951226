#include "cli/commands/bench_overhead.h"

#include <iostream>

#include "base/atomic_write.h"
#include "base/csv_field.h"
#include "base/formatted.h"
#include "base/printable.h"
#include "batch/machine.h"
#include "batch/output_folder.h"
#include "cli/interrupt.h"
#include "cli/subcommand.h"
#include "formats/open_file.h"
#include "formats/scene_file.h"
#include "study/kernels/meter_overhead.h"

namespace hooke {

int bench_overhead(const std::filesystem::path& folder, const std::vector<std::string>& scenes,
                   const std::vector<const Integrator*>& methods, bool quick, bool quiet) {
  std::vector<std::string> names = scenes;
  if (names.empty()) names.assign(overhead_scenes().begin(), overhead_scenes().end());
  std::vector<Scene> loaded;
  for (const std::string& name : names) loaded.push_back(load_file(find_scene(name)).scene);
  make_folder(folder);
  catch_interrupts();

  std::string csv = "scene,method,substeps,frame_ms,overhead\n";
  if (!quiet) {
    std::cout << machine() << "\n\n| time of a frame [ms], and what measuring its error and the energy balance adds |";
    for (std::size_t i = 0; i < names.size(); ++i)
      std::cout << " " << printable(names[i], 80) << " (" << loaded[i].system.point_count() << ") |";
    std::cout << "\n|---|";
    for (std::size_t i = 0; i < names.size(); ++i) std::cout << "---|";
    std::cout << "\n";
  }
  for (const Integrator* method : methods) {
    if (!quiet) std::cout << "| `" << method->id << "` |" << std::flush;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (was_interrupted()) return exit_interrupted();
      const MeterOverhead measured =
          quick ? measure_meter_overhead(loaded[i], *method, 1, 0.0) : measure_meter_overhead(loaded[i], *method, 3, 0.5);
      append_formatted(csv, "%s,%s,%d,", csv_field(printable(names[i], 80)).c_str(), std::string(method->id).c_str(), measured.substeps);
      csv += measured.has_diverged ? ",\n" : formatted("%.4g,%.3g\n", 1e3 * measured.frame_seconds, measured.overhead);
      if (quiet) continue;
      if (measured.has_diverged)
        std::cout << " diverges |" << std::flush;
      else
        std::cout << formatted(" %.2g: %.1f %% |", 1e3 * measured.frame_seconds, 100.0 * measured.overhead) << std::flush;
    }
    if (!quiet) std::cout << "\n";
  }
  write_atomically(folder / "overhead.csv", csv);
  return exit_code::success;
}

}  // namespace hooke
