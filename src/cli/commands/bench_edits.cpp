#include "cli/commands/bench_tables.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/atomic_write.h"
#include "base/formatted.h"
#include "batch/output_file.h"
#include "cli/interrupt.h"
#include "cli/subcommand.h"
#include "edit/command.h"
#include "formats/scene_file.h"
#include "lab/lab_thread.h"
#include "scene/parameters.h"
#include "scene/scene.h"

namespace hooke {
namespace {

struct EditCase {
  std::string_view name;
  // The edit number k of this scene, of a point, a spring or a value that none before concerns.
  Command (*command)(const Scene& scene, int k);
};

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

constexpr std::array edit_cases{
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

// A cloth of n x n points that hangs from two corners, with velocity_verlet and 2.25 n substeps per frame, within the limit of any
// deformation.
Scene make_edited_cloth(int n) {
  return parse_scene(formatted(R"({"hooke": 1, "gravity": [0, 0, -9.81],
      "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [%d, %d], "density": 0.2,
                      "stiffness": 1000, "shear_stiffness": 500, "mass_model": "equal", "nail": ["top_left", "top_right"]}],
      "simulation": {"integrator": "velocity_verlet", "frame_rate": 60, "substeps": %d}})",
                               n, n, 9 * n / 4),
                     "cloth")
      .scene;
}

// From the moment when the window passes an edit on until the state that it draws next contains it [s], the median of `count` edits of the
// running scene, each at another time of a frame.
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

}  // namespace

int bench_edits(const std::filesystem::path& folder, bool quick, bool quiet) {
  make_folder(folder);
  catch_interrupts();
  const std::vector<int> sizes = quick ? std::vector{32} : std::vector{64, 128, 256};
  const int count = quick ? 3 : 15;
  std::vector<Scene> scenes;
  for (const int n : sizes) scenes.push_back(make_edited_cloth(n));

  std::string csv = "edit,points,springs,ms\n";
  if (!quiet) print_head("time until an edit of a running cloth is seen [ms]", sizes, size_text);
  for (const EditCase& row : edit_cases) {
    if (!quiet) std::cout << "| " << row.name << " |" << std::flush;
    for (const Scene& scene : scenes) {
      if (was_interrupted()) return exit_interrupted();
      const double ms = 1e3 * measure_edit(row, scene, count);
      append_formatted(csv, "%s,%d,%d,%.4g\n", std::string(row.name).c_str(), scene.system.point_count(), scene.system.spring_count(), ms);
      if (!quiet) std::cout << formatted(" %.3g |", ms) << std::flush;
    }
    if (!quiet) std::cout << "\n";
  }
  write_atomically(folder / "edits.csv", csv);
  return exit_code::success;
}

}  // namespace hooke
