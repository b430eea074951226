#include "study/kernels/kernel_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "base/formatted.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "study/benchmark.h"

namespace hooke {
namespace {

constexpr std::array rows{
    KernelCase{"grid", "the cloth alone", "", ""},
    KernelCase{"drag", "with drag", R"(, "drag": 0.1)", ""},
    KernelCase{"plane below", "with a plane that nothing touches",
               R"(, "colliders": [{"type": "plane", "point": [0, 0, -9], "normal": [0, 0, 1]}])", ""},
    KernelCase{"at rest on a plane", "lies on a plane",
               R"(, "colliders": [{"type": "plane", "point": [0, 0, -0.004], "normal": [0, 0, 1], "friction": 0.5}])", ""},
    KernelCase{"dashpots", "with dashpots", "", R"(, "damping": 0.001)"},
    KernelCase{"bend springs", "with springs to the second next point, which are not part of the grid", "", R"(, "bend_stiffness": 100)"},
    KernelCase{"shuffled", "points and springs in random order", "", "", true},
};

// Numbers from a fixed seed (Steele, Lea and Flood 2014, splitmix64): the same order everywhere.
class Random {
 public:
  std::size_t below(std::size_t limit) {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<std::size_t>((z ^ (z >> 31)) % limit);
  }

 private:
  std::uint64_t state_ = 1;
};

std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

// The same net with its points and springs in another order.
void shuffle(Scene& scene) {
  Random random;
  const std::vector<Point> points = scene.system.points();
  const std::vector<Spring> springs = scene.system.springs();
  const State state = scene.state;
  std::vector<Point> new_points;
  std::vector<Spring> new_springs;
  for (const std::size_t from : shuffled(points.size(), random)) {
    scene.state.position[new_points.size()] = state.position[from];
    scene.state.velocity[new_points.size()] = state.velocity[from];
    new_points.push_back(points[from]);
  }
  for (const std::size_t from : shuffled(springs.size(), random)) new_springs.push_back(springs[from]);
  scene.system.set_points(std::move(new_points));
  scene.system.set_springs(std::move(new_springs));
}

}  // namespace

std::span<const KernelCase> kernel_cases() { return rows; }

Scene make_kernel_scene(const KernelCase& row, int n, int substeps) {
  const bool lies = row.name == "at rest on a plane";
  const std::string text = formatted(
      R"({"hooke": 1, "gravity": [0, 0, -9.81], "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0],
          "points": [%d, %d], "density": 0.2, "stiffness": 1000, "shear_stiffness": 500, "mass_model": "equal", "point_radius": 0.004%s%s}],
          "simulation": {"integrator": "velocity_verlet", "frame_rate": %.17g, "substeps": %d}%s})",
      n, n, lies ? "" : R"(, "nail": ["top_left", "top_right"])", std::string(row.generator).c_str(), 4.0 * 86.6 * n / substeps, substeps,
      std::string(row.members).c_str());
  Scene scene = parse_scene(text, "cloth").scene;
  if (row.is_shuffled) shuffle(scene);
  return scene;
}

KernelTime measure_kernel(const KernelCase& row, int n, bool quick) {
  const int frames = quick ? 2 : 6;
  const int substeps = std::max(30, (quick ? 1'000'000 : 4'000'000) / (4 * n * n));
  Lab lab(make_kernel_scene(row, n, substeps), KeepStart::No);
  KernelTime time{.points = lab.scene().system.point_count(), .springs = lab.scene().system.spring_count(), .step_seconds = HUGE_VAL};
  for (int frame = 0; frame < frames; ++frame) {
    const double start = cpu_seconds();
    lab.step();
    time.step_seconds = std::min(time.step_seconds, (cpu_seconds() - start) / substeps);
  }
  return time;
}

}  // namespace hooke
