#include "cli/commands/bench_edits.h"

#include <iostream>
#include <string>
#include <vector>

#include "base/atomic_write.h"
#include "base/formatted.h"
#include "batch/machine.h"
#include "batch/output_folder.h"
#include "cli/interrupt.h"
#include "cli/subcommand.h"
#include "study/kernels/edit_latency.h"

namespace hooke {

int bench_edits(const std::filesystem::path& folder, bool quick, bool quiet) {
  make_folder(folder);
  catch_interrupts();
  const std::vector<int> sizes = quick ? std::vector{32} : std::vector{64, 128, 256};
  const int count = quick ? 3 : 15;
  std::vector<Scene> scenes;
  for (const int n : sizes) scenes.push_back(make_edited_cloth(n));

  std::string csv = "edit,points,springs,ms\n";
  if (!quiet) {
    std::cout << machine() << "\n\n| time until an edit of a running cloth is seen [ms] |";
    for (const int n : sizes) std::cout << " " << n << " x " << n << " |";
    std::cout << "\n|---|";
    for (std::size_t i = 0; i < sizes.size(); ++i) std::cout << "---|";
    std::cout << "\n";
  }
  for (const EditCase& row : edit_cases()) {
    if (!quiet) std::cout << "| " << row.name << " |" << std::flush;
    for (const Scene& scene : scenes) {
      if (was_interrupted()) return exit_interrupted();
      const double ms = 1e3 * measure_edit(row, scene, count);
      append_formatted(csv, "%s,%d,%d,%.4g\n", std::string(row.name).c_str(), scene.system.point_count(), scene.system.spring_count(), ms);
      if (!quiet) std::cout << formatted(" %.3g |", ms) << std::flush;
    }
    if (!quiet) std::cout << "\n";
  }
  write_atomically(folder / "edits.csv", csv);
  return exit_code::success;
}

}  // namespace hooke
