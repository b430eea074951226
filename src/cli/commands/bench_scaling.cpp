#include "cli/commands/bench_tables.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <functional>
#include <iostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/atomic_write.h"
#include "base/errors.h"
#include "base/formatted.h"
#include "base/threads/thread_time.h"
#include "batch/machine.h"
#include "batch/output_file.h"
#include "batch/run_frames.h"
#include "cli/interrupt.h"
#include "cli/subcommand.h"
#include "lab/lab.h"
#include "study/benchmark.h"
#include "study/kernels/kernel_cases.h"

namespace hooke {
namespace {

// A cloth of n x n points run with velocity_verlet, in a process of its own.
struct ScalingRow {
  int n = 0;
  long springs = 0;
  double step_ms = 0.0;     // CPU time of a step, the minimum of several frames
  double peak_bytes = 0.0;  // peak resident memory, without that of a process that does nothing
  double ns_per_spring() const { return step_ms * 1e6 / static_cast<double>(springs); }
  double bytes_per_spring() const { return peak_bytes / static_cast<double>(springs); }
};

// Points along a side of the cloths, for quick measurements only those of less than 1e5 springs.
constexpr std::array scaling_sizes{16, 32, 64, 128, 256, 512, 1024};
constexpr std::size_t quick_sizes = 4;

// A frame has so many steps that what is done once per frame hardly counts.
Scene make_cloth(int n) { return make_kernel_scene(kernel_cases().front(), n, std::max(50, 10'000'000 / (4 * n * n))); }

struct Figures {
  long springs = 0;
  double step_seconds = 0.0;
};

Figures step_cloth(int n) {
  constexpr int frames = 6;
  Lab lab(make_cloth(n), KeepStart::No);
  // with what `hooke run` keeps besides
  run_frames(lab, {.seconds = 1.0 / lab.scene().settings.frame_rate, .accuracy = AccuracyMode::Off}, {});
  Figures figures{.springs = lab.scene().system.spring_count(), .step_seconds = HUGE_VAL};
  for (int frame = 0; frame < frames; ++frame) {
    const double start = thread_cpu_seconds();
    lab.step();
    figures.step_seconds = std::min(figures.step_seconds, (thread_cpu_seconds() - start) / lab.scene().settings.substeps);
  }
  return figures;
}

[[noreturn]] void fail(const std::string& what) { throw FileError("bench: " + what + ": " + std::strerror(errno)); }

// What `work` returns in a process of its own, and the peak memory of that process [bytes].
std::pair<Figures, double> in_own_process(const std::function<Figures()>& work) {
  int ends[2];
  if (pipe(ends) != 0) fail("no pipe");
  const pid_t child = fork();
  if (child < 0) fail("no process");
  if (child == 0) {
    const Figures figures = work();
    const bool is_written = write(ends[1], &figures, sizeof figures) == static_cast<ssize_t>(sizeof figures);
    _exit(is_written ? 0 : 1);
  }
  close(ends[1]);
  Figures figures;
  const bool is_read = read(ends[0], &figures, sizeof figures) == static_cast<ssize_t>(sizeof figures);
  close(ends[0]);
  rusage usage{};
  int status = 0;
  while (wait4(child, &status, 0, &usage) < 0)
    if (errno != EINTR) fail("no exit status");
  if (!is_read || !WIFEXITED(status) || WEXITSTATUS(status) != 0) throw FileError("bench: a run failed: out of memory?");
  return {figures, 1024.0 * static_cast<double>(usage.ru_maxrss)};
}

// Throws FileError if a process cannot be started or fails.
ScalingRow measure_scaling(int n) {
  const double bare = in_own_process([] { return Figures{}; }).second;
  const auto [figures, peak] = in_own_process([n] { return step_cloth(n); });
  return {.n = n, .springs = figures.springs, .step_ms = 1e3 * figures.step_seconds, .peak_bytes = peak - bare};
}

// The slope of log(time of a step) over log(springs), by least squares; 1: proportional.
double scaling_slope(const std::vector<ScalingRow>& rows) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto count = static_cast<double>(rows.size());
  for (const ScalingRow& row : rows) {
    const double springs = std::log(static_cast<double>(row.springs)), time = std::log(row.step_ms);
    x += springs;
    y += time;
    xx += springs * springs;
    xy += springs * time;
  }
  return (count * xy - x * y) / (count * xx - x * x);
}

}  // namespace

int bench_scaling(const std::filesystem::path& folder, bool quick, bool quiet) {
  make_folder(folder);
  catch_interrupts();
  std::string csv = "points,springs,step_ms,ns_per_spring,peak_mib,bytes_per_spring\n";
  if (!quiet)
    std::cout
        << "velocity_verlet, double precision, one thread of: " << machine() << "\n\n"
        << "| cloth | springs | ms per step | ns per spring and step | peak memory [MiB] | bytes per spring |\n|---|---|---|---|---|---|\n";
  std::vector<ScalingRow> rows;
  for (const int n : std::span(scaling_sizes).first(quick ? quick_sizes : scaling_sizes.size())) {
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
