#include "cli/commands/bench_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "base/atomic_write.h"
#include "base/csv_field.h"
#include "base/formatted.h"
#include "base/printable.h"
#include "base/threads/thread_time.h"
#include "batch/output_file.h"
#include "cli/interrupt.h"
#include "cli/subcommand.h"
#include "formats/open_file.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/scene.h"
#include "sim/methods/step_limits.h"
#include "study/benchmark.h"

namespace hooke {
namespace {

struct MeterOverhead {
  int substeps = 1;            // with which it was measured; 1 for methods that choose their own steps
  double frame_seconds = 0.0;  // [s], CPU time of a frame without measuring
  double overhead = 0.0;       // [1], additional CPU time with AccuracyMode::Frame, relative to that
  bool has_diverged = false;
};

// Shipped scenes of 2 to 1024 points, with and without contact.
constexpr std::array<std::string_view, 5> overhead_scenes{"two_masses", "rope_64", "cloth", "cloth_on_ball", "drum_32"};

// One of 40 is repeated (accuracy_meter.cpp).
constexpr int frames_of_run = 80;
// Implicit methods are measured with few substeps, the others at least with those of the scene.
constexpr int min_implicit_substeps = 2, max_measured_substeps = 400;

int substeps_to_measure(const Scene& scene, const Integrator& method) {
  if (method.stability == Stability::Adaptive) return 1;
  const int stable =
      StepLimits(make_plan(scene.system).spectrum).stable_substeps(method, scene.settings.frame_rate).value_or(max_measured_substeps);
  const int min = method.implicit_solve == ImplicitSolve::None ? scene.settings.substeps : min_implicit_substeps;
  return std::min(std::max(2 * std::min(stable, max_measured_substeps), min), max_measured_substeps);
}

// CPU time of a run [s]; infinite if it diverges.
double time_of_run(const Scene& scene, AccuracyMode mode) {
  Lab lab(scene, KeepStart::No);
  lab.submit(SetAccuracy{mode});
  lab.apply_pending();
  const double start = thread_cpu_seconds();
  for (int frame = 0; frame < frames_of_run; ++frame)
    if (!lab.step()) return HUGE_VAL;
  return thread_cpu_seconds() - start;
}

// From pairs of runs of 80 frames, the same with and without measuring: the minimum times over at least `min_rounds` pairs, and more for
// about `seconds` [s]. The method takes twice the fewest stable substeps, at least 2 if it is implicit, and otherwise at least those of the
// scene.
MeterOverhead measure_meter_overhead(Scene scene, const Integrator& method, int min_rounds, double seconds) {
  scene.settings.integrator = &method;
  scene.settings.tolerance.reset();
  MeterOverhead result{.substeps = substeps_to_measure(scene, method)};
  scene.settings.substeps = result.substeps;
  double plain = HUGE_VAL, measured = HUGE_VAL, spent = 0.0;
  for (int round = 0; round < min_rounds || spent < seconds; ++round) {
    const double without = time_of_run(scene, AccuracyMode::Off), with = time_of_run(scene, AccuracyMode::Frame);
    plain = std::min(plain, without);
    measured = std::min(measured, with);
    spent += without + with;
    if (!std::isfinite(spent)) {
      result.has_diverged = true;
      return result;
    }
  }
  result.frame_seconds = plain / frames_of_run;
  result.overhead = measured / plain - 1.0;
  return result;
}

}  // namespace

int bench_overhead(const std::filesystem::path& folder, const std::vector<std::string>& scenes,
                   const std::vector<const Integrator*>& methods, bool quick, bool quiet) {
  std::vector<std::string> names = scenes;
  if (names.empty()) names.assign(overhead_scenes.begin(), overhead_scenes.end());
  std::vector<Scene> loaded;
  for (const std::string& name : names) loaded.push_back(load_file(find_scene(name)).scene);
  make_folder(folder);
  catch_interrupts();

  std::string csv = "scene,method,substeps,frame_ms,overhead\n";
  std::size_t scene = 0;
  const auto heading = [&](const std::string& name) {
    return printable(name, 80) + " (" + std::to_string(loaded[scene++].system.point_count()) + ")";
  };
  if (!quiet) print_head("time of a frame [ms], and what measuring its error and the energy balance adds", names, heading);
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
