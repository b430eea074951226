#include "study/kernels/kernel_cases.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>

#include "base/formatted.h"
#include "base/threads/thread_team.h"
#include "base/threads/thread_time.h"
#include "formats/scene_file.h"
#include "sim/control/frame_runner.h"
#include "sim/forces/single_precision.h"
#include "sim/model/portable_math.h"
#include "study/benchmark.h"
#include "study/hard_cases/test_network.h"

namespace hooke {
namespace {

// across which the cloth falls
constexpr std::string_view ball_and_floor =
    R"(, "colliders": [{"type": "sphere", "center": [0.5, -0.5, -0.35], "radius": 0.3, "friction": 0.3},
                    {"type": "plane", "point": [0, 0, -0.66], "normal": [0, 0, 1], "friction": 0.3}])";

// on which it folds onto itself
constexpr std::string_view floor_and_folds =
    R"(, "contact": {"faces": true, "thickness": 0.004, "friction": 0.3},
         "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.3}])";

constexpr double implicit_step = 1.0 / 60.0;  // [s]

constexpr std::array rows{
    KernelCase{.name = "grid"},
    KernelCase{.name = "grid on two threads", .threads = 2},
    KernelCase{.name = "grid in single precision", .is_single = true},
    KernelCase{.name = "grid in single precision on two threads", .threads = 2, .is_single = true},
    KernelCase{.name = "drag", .members = R"(, "drag": 0.1)"},
    KernelCase{.name = "plane below", .members = R"(, "colliders": [{"type": "plane", "point": [0, 0, -9], "normal": [0, 0, 1]}])"},
    KernelCase{.name = "at rest on a plane",
               .members = R"(, "colliders": [{"type": "plane", "point": [0, 0, -0.004], "normal": [0, 0, 1], "friction": 0.5}])",
               .is_nailed = false},
    KernelCase{.name = "at rest on a plane on two threads",
               .members = R"(, "colliders": [{"type": "plane", "point": [0, 0, -0.004], "normal": [0, 0, 1], "friction": 0.5}])",
               .is_nailed = false,
               .threads = 2},
    KernelCase{.name = "slides on a plane",
               .members = R"(, "drag": 0.5, "wind": [40, 0, 0],
                            "colliders": [{"type": "plane", "point": [0, 0, -0.004], "normal": [0, 0, 1], "friction": 0.5}])",
               .is_nailed = false},
    KernelCase{.name = "on a ball and a floor", .members = ball_and_floor, .is_nailed = false, .settle = 1.0, .max_size = 64},
    KernelCase{.name = "falls into its folds",
               .members = floor_and_folds,
               .is_nailed = false,
               .is_dropped = true,
               .rate = 1.125,
               .settle = 0.4,
               .max_size = 64},
    KernelCase{.name = "lies in its folds",
               .members = floor_and_folds,
               .is_nailed = false,
               .is_dropped = true,
               .rate = 1.125,
               .settle = 1.0,
               .max_size = 64},
    KernelCase{.name = "dashpots", .generator = R"(, "damping": 0.001)", .method = "velocity_verlet_explicit"},
    KernelCase{.name = "dashpots in sweeps", .generator = R"(, "damping": 0.001)"},
    KernelCase{.name = "wind",
               .members = R"(, "forces": [{"type": "wind", "x": 1, "y": 0, "z": 2}])",
               .method = "velocity_verlet_explicit",
               .max_size = 256},
    KernelCase{.name = "strain limit", .members = R"(, "strain_limit_percent": 50)"},
    KernelCase{.name = "breakable", .members = R"(, "break_strain": 0.5)"},
    KernelCase{.name = "center", .members = R"(, "forces": [{"type": "center", "z": -2, "strength": 1}])", .max_size = 256},
    KernelCase{.name = "bend springs", .generator = R"(, "bend_stiffness": 100)"},
    KernelCase{.name = "general graph", .generator = R"(, "damping": 0)", .is_block = true, .max_size = 128},
    KernelCase{.name = "jelly block", .is_block = true, .max_size = 128},
    KernelCase{.name = "blanes_moan4 per evaluation", .method = "blanes_moan4", .unit = KernelUnit::ForceEvaluation, .max_size = 256},
    KernelCase{.name = "runge_kutta4 per evaluation", .method = "runge_kutta4", .unit = KernelUnit::ForceEvaluation, .max_size = 256},
    KernelCase{.name = "dop853 per evaluation", .method = "dop853", .unit = KernelUnit::ForceEvaluation, .max_size = 256},
    KernelCase{.name = "xpbd per sweep", .method = "xpbd", .unit = KernelUnit::Sweep, .max_size = 256},
    KernelCase{.name = "baraff_witkin per 1/60 s", .method = "baraff_witkin", .step = implicit_step, .max_size = 64},
    KernelCase{.name = "tr_bdf2 per 1/60 s", .method = "tr_bdf2", .step = implicit_step, .max_size = 64},
};

// On its lower edge, just above the floor.
void stand(Scene& scene) {
  for (Vec3& x : scene.state.position) {
    const double u = x.x, v = -x.y;
    x = Vec3(u - 0.5, 0.05 * portable::sin(9.0 * v) + 0.02 * portable::sin(7.0 * u + 5.0 * v), 1.02 - v);
  }
}

}  // namespace

std::span<const KernelCase> kernel_cases() { return rows; }

Scene make_kernel_scene(const KernelCase& row, int n, int substeps) {
  const int edge = std::max(2, 6 * n / 32);
  const std::string net =
      row.is_block ? formatted(R"({"type": "jelly", "columns": %d, "rows": %d, "layers": %d%s})", edge, edge, edge,
                               std::string(row.generator).c_str())
                   : formatted(R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [%d, %d],
                                   "density": 0.2, "stiffness": 1000, "shear_stiffness": 500, "mass_model": "equal",
                                   "point_radius": 0.004%s%s})",
                               n, n, row.is_nailed ? R"(, "nail": ["top_left", "top_right"])" : "", std::string(row.generator).c_str());
  const double rate = row.step > 0.0 ? 1.0 / row.step : row.rate * 86.6 * n;  // [1/s], of the steps
  const std::string text = formatted(
      R"({"hooke": 1, "gravity": [0, 0, -9.81], "generators": [%s],
          "simulation": {"integrator": "%s", "frame_rate": %.17g, "substeps": %d}%s})",
      net.c_str(), std::string(row.method).c_str(), rate / substeps, substeps, std::string(row.members).c_str());
  Scene scene = parse_scene(text, "cloth").scene;
  if (row.is_dropped) stand(scene);
  return scene;
}

KernelTime measure_kernel(const KernelCase& row, int n, bool quick, const std::shared_ptr<FrameDevice>& device) {
  const int frames = quick ? 2 : 6;
  const int substeps = row.step > 0.0 ? 1 : std::max(30, (quick ? 1'000'000 : 4'000'000) / (4 * n * n));
  Scene scene = make_kernel_scene(row, n, substeps);
  KernelTime time{.points = scene.system.point_count(), .springs = scene.system.spring_count(), .seconds = HUGE_VAL};
  Plan plan = make_plan(scene.system);
  if (row.threads > 1) plan.execution.team = std::make_shared<ThreadTeam>(row.threads);
  if (row.is_single) plan.execution.single = std::make_shared<SinglePrecision>();
  plan.execution.device = device;
  // other threads take CPU time while they wait
  const auto now = [&] {
    const std::chrono::duration<double> real = std::chrono::steady_clock::now().time_since_epoch();
    return row.threads > 1 || device != nullptr ? real.count() : thread_cpu_seconds();
  };
  FrameRunner frame;
  const auto take_frame = [&] {
    const double start = now();
    frame.begin(plan, scene.system, scene.settings, scene.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, scene.state);
    return now() - start;
  };
  while (scene.state.time < row.settle) take_frame();
  for (int i = 0; i < frames; ++i) {
    const double seconds = take_frame();
    const Motion& motion = frame.motion();
    const long count = row.unit == KernelUnit::Sweep             ? motion.counts.sweeps
                       : row.unit == KernelUnit::ForceEvaluation ? motion.counts.force_evaluations
                                                                 : substeps;
    time.seconds = std::min(time.seconds, seconds / static_cast<double>(std::max(1L, count)));
  }
  return time;
}

}  // namespace hooke
