#include "cli/commands/bench_tables.h"

#include <iostream>
#include <vector>

#include "base/atomic_write.h"
#include "base/formatted.h"
#include "batch/machine.h"
#include "batch/output_file.h"
#include "cli/interrupt.h"
#include "cli/scene_options.h"
#include "cli/subcommand.h"
#include "device/gpu_device.h"
#include "study/kernels/kernel_cases.h"
#include "study/kernels/machine_limits.h"

namespace hooke {
namespace {

std::string limits_table(const MachineLimits& limits) {
  std::string text = machine() + "\n\n| limit of one core | double precision | single precision |\n|---|---|---|\n";
  const ArithmeticLimits &in_double = limits.double_precision, &in_single = limits.single_precision;
  append_formatted(text, "| values in a vector | %d | %d |\n", in_double.lanes, in_single.lanes);
  append_formatted(text, "| fused multiply-adds | %.1f GFLOP/s | %.1f GFLOP/s |\n", 2e-9 * in_double.fma_rate, 2e-9 * in_single.fma_rate);
  append_formatted(text, "| square root of a vector | %.2f ns | %.2f ns |\n", 1e9 * in_double.sqrt_time * in_double.lanes,
                   1e9 * in_single.sqrt_time * in_single.lanes);
  append_formatted(text, "| division of a vector | %.2f ns | %.2f ns |\n", 1e9 * in_double.division_time * in_double.lanes,
                   1e9 * in_single.division_time * in_single.lanes);
  for (const TriadLimit& triad : limits.triads)
    append_formatted(text, "| triad in %s (%.3g MiB), 1 / 2 threads | %.1f / %.1f GB/s | |\n", triad.level.c_str(), triad.bytes / (1 << 20),
                     1e-9 * triad.one_thread, 1e-9 * triad.two_threads);
  return text;
}

}  // namespace

int bench_kernels(const std::filesystem::path& folder, Device device, bool quick, bool quiet) {
  const std::shared_ptr<GpuDevice> gpu = device == Device::Gpu ? open_gpu() : nullptr;
  if (gpu != nullptr && !quiet) print_device({.device = gpu});
  make_folder(folder);
  catch_interrupts();
  const MachineLimits limits = measure_machine_limits(quick);
  const std::vector<int> sizes = quick ? std::vector{32, 64} : std::vector{32, 64, 128, 256, 512, 1024};
  std::string csv = "case,points,springs,ns_per_spring,limit_ns_per_spring,part_of_limit\n";
  if (!quiet) {
    std::cout << limits_table(limits) << "\n| velocity_verlet or named, ns per spring and step (part of the limit) |";
    for (const int n : sizes) std::cout << " " << n << " x " << n << " |";
    std::cout << "\n|---|";
    for (std::size_t i = 0; i < sizes.size(); ++i) std::cout << "---|";
    std::cout << "\n";
  }
  for (const KernelCase& row : kernel_cases()) {
    if (!quiet) std::cout << "| " << row.name << " |" << std::flush;
    for (const int n : sizes) {
      if (was_interrupted()) return exit_interrupted();
      // in a quick run, not those that take long to settle
      const Scene scene = make_kernel_scene(row, sizes.front(), 1);
      const bool needs_cpu = gpu != nullptr && (row.threads > 1 || row.is_at_rest ||
                                                !needs_processor(make_plan(scene.system), *scene.settings.integrator).empty());
      if (n > (quick && row.settle > 0.0 ? sizes.front() : row.max_size) || needs_cpu) {
        if (!quiet) std::cout << " |";
        continue;
      }
      const KernelTime time = measure_kernel(row, n, quick, gpu);
      const double each = time.seconds / static_cast<double>(time.springs);
      append_formatted(csv, "%s,%ld,%ld,%.4g,", std::string(row.name).c_str(), time.points, time.springs, 1e9 * each);
      std::string cell = formatted(" %.2f", 1e9 * each);
      // no limit where the forces of springs are not computed in every step
      if (row.is_at_rest)
        csv += ",\n";
      else {
        const double limit = shortest_time_per_spring(limits, {.points = static_cast<double>(time.points),
                                                               .springs = static_cast<double>(time.springs),
                                                               .threads = row.threads,
                                                               .is_single = row.is_single});
        append_formatted(csv, "%.4g,%.3g\n", 1e9 * limit, limit / each);
        append_formatted(cell, " (%.0f %%)", 100.0 * limit / each);
      }
      if (!quiet) std::cout << cell << " |" << std::flush;
    }
    if (!quiet) std::cout << "\n";
  }
  write_atomically(folder / "kernels.csv", csv);
  return exit_code::success;
}

}  // namespace hooke
