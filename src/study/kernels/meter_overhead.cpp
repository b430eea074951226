#include "study/kernels/meter_overhead.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/threads/thread_time.h"
#include "lab/lab.h"
#include "sim/methods/step_limits.h"
#include "study/benchmark.h"

namespace hooke {
namespace {

constexpr std::array<std::string_view, 5> meter_scenes{"two_masses", "rope_64", "cloth", "cloth_on_ball", "drum_32"};

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

}  // namespace

std::span<const std::string_view> overhead_scenes() { return meter_scenes; }

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

}  // namespace hooke
