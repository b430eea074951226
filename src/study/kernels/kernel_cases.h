// The scenes of `bench --kernels`: cloths that differ in one feature of stepping each, and a jelly block.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "scene/scene.h"

namespace hooke {

class FrameDevice;

// What the time of a case is divided by, besides the springs.
enum class KernelUnit { Step, ForceEvaluation, Sweep };

struct KernelCase {
  std::string_view name;
  std::string_view members;    // of the scene, besides the net
  std::string_view generator;  // members of the generator of the net
  bool is_block = false;       // the jelly block instead of the cloth
  bool is_nailed = true;       // the cloth hangs from two corners; false: it falls
  bool is_dropped = false;     // it is vertical and slightly wavy, and falls on its lower edge
  std::string_view method = "velocity_verlet";
  KernelUnit unit = KernelUnit::Step;
  double step = 0.0;    // [s]; 0: `rate` steps in that at which the net becomes unstable
  double rate = 4.0;    // [1]
  double settle = 0.0;  // [s], simulated before it is measured
  int max_size = 1024;  // the largest n for which it is measured
  int threads = 1;
  bool is_single = false;  // in single precision
};
std::span<const KernelCase> kernel_cases();

// A cloth of n x n points, or a jelly block of 6 n / 32 points along each edge, with `substeps` per frame. The block of 6 is the default
// one.
Scene make_kernel_scene(const KernelCase& row, int n, int substeps);

// The CPU time [s], with several threads the real time, of a step, a force evaluation or a sweep over the springs as constraints, the
// minimum of six frames, of two if `quick`. A frame has so many steps that what is done once per frame hardly counts.
struct KernelTime {
  long points = 0, springs = 0;
  double seconds = 0.0;
};
// `device`: computes the frames, in real time; it may throw UsageError.
KernelTime measure_kernel(const KernelCase& row, int n, bool quick, const std::shared_ptr<FrameDevice>& device = nullptr);

}  // namespace hooke
