#include "cli/commands/bench_tables.h"

#include <vector>

#include "base/atomic_write.h"
#include "base/formatted.h"
#include "batch/output_file.h"
#include "cli/interrupt.h"
#include "cli/scene_options.h"
#include "cli/subcommand.h"
#include "device/gpu_device.h"
#include "study/kernels/kernel_cases.h"

namespace hooke {

int bench_kernels(const std::filesystem::path& folder, Device device, bool quick, bool quiet) {
  const std::shared_ptr<GpuDevice> gpu = device == Device::Gpu ? open_gpu() : nullptr;
  if (gpu != nullptr && !quiet) print_device({.device = gpu});
  make_folder(folder);
  catch_interrupts();
  const std::vector<int> sizes = quick ? std::vector{32, 64} : std::vector{32, 64, 128, 256, 512, 1024};
  std::string csv = "case,points,springs,ns_per_spring\n";
  if (!quiet) print_head("velocity_verlet or named, ns per spring and step", sizes, size_text);
  for (const KernelCase& row : kernel_cases()) {
    const Scene scene = make_kernel_scene(row, sizes.front(), 1);
    const bool is_for_gpu = row.threads == 1 && needs_processor(make_plan(scene.system), *scene.settings.integrator).empty();
    if (gpu != nullptr && !is_for_gpu) continue;
    if (!quiet) std::cout << "| " << row.name << " |" << std::flush;
    for (const int n : sizes) {
      if (was_interrupted()) return exit_interrupted();
      // in a quick run, not those that take long to settle
      if (n > (quick && row.settle > 0.0 ? sizes.front() : row.max_size)) {
        if (!quiet) std::cout << " |";
        continue;
      }
      const KernelTime time = measure_kernel(row, n, quick, gpu);
      const double ns = 1e9 * time.seconds / static_cast<double>(time.springs);
      append_formatted(csv, "%s,%ld,%ld,%.4g\n", std::string(row.name).c_str(), time.points, time.springs, ns);
      if (!quiet) std::cout << formatted(" %.2f |", ns) << std::flush;
    }
    if (!quiet) std::cout << "\n";
  }
  write_atomically(folder / "kernels.csv", csv);
  return exit_code::success;
}

}  // namespace hooke
