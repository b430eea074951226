#include "study/kernels/edit_latency.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>
#include <vector>

#include "base/formatted.h"
#include "formats/scene_file.h"
#include "lab/lab_thread.h"
#include "scene/parameters.h"

namespace hooke {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto long_enough = std::chrono::seconds(60);

// Away from the nails.
const Point& point_of(const Scene& scene, int k) {
  const Index at = scene.system.point_count() / 2 + k;
  return scene.system.points()[at];
}
Spring spring_of(const Scene& scene, int k) {
  const Index at = scene.system.spring_count() / 2 + k;
  return scene.system.springs()[at];
}

constexpr std::array cases{
    EditCase{"nail a point",
             [](const Scene& scene, int k) -> Command { return SetNailed{{{.point = point_of(scene, k).id, .nailed = true}}}; }},
    EditCase{
        "drag a point",
        [](const Scene& scene, int k) -> Command { return GrabPoint{{.point = point_of(scene, k).id, .target = Vec3(0.5, -0.5, 0.1)}}; }},
    EditCase{"stiffness of all springs",
             [](const Scene&, int k) -> Command {
               return SetParameter{find_parameter("stiffness"), 990.0 - k};
             }},
    EditCase{"delete a spring",
             [](const Scene& scene, int k) -> Command { return Remove{.points = {}, .springs = {spring_of(scene, k).id}}; }},
    EditCase{"add a spring",
             [](const Scene& scene, int k) -> Command {
               Spring spring = spring_of(scene, k);
               spring.id = SpringId{scene.system.next_spring_id() + static_cast<std::uint32_t>(k)};
               spring.second = point_of(scene, 2 * k + 100).id;
               return Insert{.points = {}, .springs = {{.at = no_index, .spring = spring}}};
             }},
};

// Waits until the running laboratory has finished another frame.
void wait_for_frame(const LabThread& lab) {
  const long frames = lab.status()->run.frames;
  const auto end = Clock::now() + long_enough;
  while (lab.status()->run.frames == frames && lab.status()->run.running && Clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

std::span<const EditCase> edit_cases() { return cases; }

Scene make_edited_cloth(int n) {
  return parse_scene(formatted(R"({"hooke": 1, "gravity": [0, 0, -9.81],
      "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [%d, %d], "density": 0.2,
                      "stiffness": 1000, "shear_stiffness": 500, "mass_model": "equal", "nail": ["top_left", "top_right"]}],
      "simulation": {"integrator": "velocity_verlet", "frame_rate": 60, "substeps": %d}})",
                               n, n, 9 * n / 4),
                     "cloth")
      .scene;
}

double measure_edit(const EditCase& row, const Scene& scene, int count) {
  LabThread lab(scene);
  lab.submit(SetRunning{true});
  std::vector<double> seconds;
  for (int k = 0; k < count; ++k) {
    // an edit that follows another within the same frame waits for its end
    wait_for_frame(lab);
    wait_for_frame(lab);
    std::this_thread::sleep_for(std::chrono::milliseconds(7 * k % 17));
    const auto start = Clock::now();
    lab.submit(row.command(scene, k));
    lab.settle(std::chrono::milliseconds(long_enough));
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  const auto median = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), median, seconds.end());
  return *median;
}

}  // namespace hooke
