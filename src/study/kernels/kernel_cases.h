// The scenes of `bench --kernels`: cloths that differ in one feature of stepping each.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace hooke {

struct KernelCase {
  std::string_view name;
  std::string_view description;
  std::string_view members;    // of the scene, besides the cloth
  std::string_view generator;  // members of the generator of the cloth
  bool is_shuffled = false;    // points and springs are listed in random order
};
std::span<const KernelCase> kernel_cases();

// A cloth of n x n points at a quarter of the step at which it becomes unstable, with `substeps` per frame.
Scene make_kernel_scene(const KernelCase& row, int n, int substeps);

// The CPU time [s] of a step, the minimum of six frames of velocity_verlet, of two if `quick`. A frame has so many steps that what is done
// once per frame hardly counts.
struct KernelTime {
  long points = 0, springs = 0;
  double step_seconds = 0.0;
};
KernelTime measure_kernel(const KernelCase& row, int n, bool quick);

}  // namespace hooke
