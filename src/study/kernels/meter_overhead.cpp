#include "study/kernels/meter_overhead.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/threads/thread_time.h"
#include "lab/lab.h"
#include "sim/methods/step_limits.h"
#include "study/benchmark.h"

namespace hooke {
namespace {

constexpr std::array<std::string_view, 5> meter_scenes{"two_masses", "rope_64", "cloth", "cloth_on_ball", "drum_32"};

// In each part of a run one frame is repeated (accuracy_meter.cpp).
constexpr int frames_of_part = 40, parts_of_run = 2;
// Implicit methods are measured with few substeps, the others at least with those of the scene.
constexpr int min_implicit_substeps = 2, max_measured_substeps = 400;

int substeps_to_measure(const Scene& scene, const Integrator& method) {
  if (method.stability == Stability::Adaptive) return 1;
  const int stable =
      StepLimits(make_plan(scene.system).spectrum).stable_substeps(method, scene.settings.frame_rate).value_or(max_measured_substeps);
  const int min = method.implicit_solve == ImplicitSolve::None ? scene.settings.substeps : min_implicit_substeps;
  return std::min(std::max(2 * std::min(stable, max_measured_substeps), min), max_measured_substeps);
}

// CPU time of each part [s]; infinite from a divergence on.
std::vector<double> run_parts(const Scene& scene, AccuracyMode mode) {
  Lab lab(scene, KeepStart::No);
  lab.submit(SetAccuracy{mode});
  lab.apply_pending();
  std::vector<double> times(parts_of_run, HUGE_VAL);
  for (double& time : times) {
    const double start = thread_cpu_seconds();
    for (int frame = 0; frame < frames_of_part; ++frame)
      if (!lab.step()) return times;
    time = thread_cpu_seconds() - start;
  }
  return times;
}

double sum_of_parts(const std::vector<double>& times) { return std::accumulate(times.begin(), times.end(), 0.0); }

}  // namespace

std::span<const std::string_view> overhead_scenes() { return meter_scenes; }

MeterOverhead measure_meter_overhead(Scene scene, const Integrator& method, int min_rounds, double seconds) {
  scene.settings.integrator = &method;
  scene.settings.tolerance.reset();
  MeterOverhead result{.substeps = substeps_to_measure(scene, method)};
  scene.settings.substeps = result.substeps;
  std::vector<double> plain(parts_of_run, HUGE_VAL), measured(parts_of_run, HUGE_VAL);
  double spent = 0.0;
  for (int round = 0; round < min_rounds || spent < seconds; ++round) {
    for (const AccuracyMode mode : {AccuracyMode::Off, AccuracyMode::Frame}) {
      const std::vector<double> times = run_parts(scene, mode);
      std::vector<double>& min = mode == AccuracyMode::Off ? plain : measured;
      for (std::size_t i = 0; i < times.size(); ++i) min[i] = std::min(min[i], times[i]);
      spent += sum_of_parts(times);
    }
    if (!std::isfinite(spent)) {
      result.has_diverged = true;
      return result;
    }
  }
  result.frame_seconds = sum_of_parts(plain) / (parts_of_run * frames_of_part);
  result.overhead = sum_of_parts(measured) / sum_of_parts(plain) - 1.0;
  return result;
}

}  // namespace hooke
