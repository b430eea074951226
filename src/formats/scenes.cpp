// The scenes that ship, and where they lie.

#include <array>
#include <system_error>

#include "base/build_info.h"
#include "base/printable.h"
#include "formats/scene_file.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// Every scene of the menu and the gallery, group by group: id, the name of its file without ".json", title, the name in it,
// and when its thumbnail is taken, so many seconds after its start.
struct Row {
  const char* group;
  const char* id;
  const char* title;
  double seconds;
};
constexpr const char *lessons = "Lessons", *cloth = "Cloth", *solids = "Solids", *hard = "Hard cases";
// clang-format off
constexpr std::array rows{
    Row{cloth, "cloth", "Cloth", 1.4},
    Row{cloth, "cloth_swing", "Cloth swing", 1.5},
    Row{cloth, "curtain", "Curtain", 1.5},
    Row{cloth, "flag", "Flag in the wind", 2.0},
    Row{cloth, "cloth_on_ball", "Cloth on a ball", 0.9},
    Row{cloth, "ball_and_quads", "Ball and quads", 0.8},
    Row{cloth, "tablecloth", "Tablecloth", 0.45},
    Row{cloth, "trampoline", "Trampoline", 0.62},
    Row{cloth, "hammock", "Hammock", 3.0},
    Row{cloth, "tearing_sheet", "Tearing sheet", 1.75},
    Row{cloth, "fast_mouse", "Fast mouse", 0.02},
    Row{lessons, "two_masses", "Two masses", 0.5},
    Row{lessons, "two_masses_bouncy", "Two masses, bouncy", 0.6},
    Row{lessons, "three_masses", "Three masses", 0.4},
    Row{lessons, "grid_4x4", "Grid 4 x 4", 0.6},
    Row{lessons, "grid_4x4_true", "Grid 4 x 4, true rest lengths", 0.6},
    Row{lessons, "assignment", "Assignment", 0.0},
    Row{lessons, "unstable", "Unstable", 7.0},
    Row{lessons, "stable", "Stable", 2.6},
    Row{lessons, "damping_ratios", "Damping ratios", 0.45},
    Row{lessons, "resonance", "Resonance", 5.97},
    Row{lessons, "normal_modes", "Normal modes", 0.0},
    Row{lessons, "rope", "Rope", 0.6},
    Row{lessons, "catenary", "Catenary", 6.0},
    Row{lessons, "spring_pendulum", "Spring pendulum", 3.0},
    Row{solids, "jelly_cubes", "Jelly cubes", 0.45},
    Row{solids, "bridge", "Bridge with a weight", 3.0},
    Row{hard, "heavy_on_light", "Heavy on light", 0.4},
    Row{hard, "stiff_and_soft", "Stiff beside soft", 1.0},
    Row{hard, "buckling", "Buckling", 0.7},
    Row{hard, "drum_32", "Drum 32", 0.3},
    Row{hard, "rope_64", "Rope 64", 0.5},
    Row{hard, "cloth_32", "Cloth 32", 0.5},
};
// clang-format on

bool is_inside(const fs::path& file, const fs::path& folder) {
  const fs::path relative_path = file.lexically_relative(folder);
  return !relative_path.empty() && *relative_path.begin() != "..";
}

// A program in the build tree reads the source tree's scenes; an installed one those beside it, wherever the
// installation was moved to, and else those where it was to be installed.
fs::path find_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    if (is_inside(program, build_folder)) return fs::path(source_scenes);
    const fs::path relative_scenes = (program.parent_path() / scenes_from_programs).lexically_normal();
    if (fs::is_directory(relative_scenes, error)) return relative_scenes;
  }
  return fs::path(installed_scenes);
}

std::string ids() {
  std::string list;
  for (const ShippedScene& scene : shipped_scenes()) list += (list.empty() ? "" : ", ") + scene.id;
  return list;
}

}  // namespace

const std::vector<ShippedScene>& shipped_scenes() {
  static const std::vector<ShippedScene> scenes = [] {
    const fs::path folder = find_folder();
    std::vector<ShippedScene> found;
    for (const Row& row : rows) found.push_back({row.id, row.title, folder / (std::string(row.id) + ".json"), row.group, row.seconds});
    return found;
  }();
  return scenes;
}

fs::path find_scene(const std::string& name) {
  std::error_code error;
  const fs::file_status status = fs::status(name, error);
  for (const ShippedScene& scene : shipped_scenes())
    if (scene.id == name && (!fs::exists(status) || fs::is_directory(status))) return scene.file;
  if (!fs::exists(status)) throw FileError(printable(name) + ": no such file, and none of the scenes that ship: " + ids());
  return name;
}

}  // namespace hooke
