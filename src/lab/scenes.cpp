// The scenes that ship, and where they lie.

#include <array>
#include <system_error>

#include "lab/build_info.h"
#include "lab/printable.h"
#include "lab/scene_file.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// Every scene of the menu, in its order: id, the name of its file without ".json", and title, the name in it.
struct Row {
  const char* id;
  const char* title;
};
constexpr std::array rows{
    Row{"cloth", "Cloth"},
    Row{"cloth_on_ball", "Cloth on a ball"},
    Row{"rope", "Rope"},
    Row{"two_masses", "Two masses"},
    Row{"two_masses_bouncy", "Two masses, bouncy"},
    Row{"three_masses", "Three masses"},
    Row{"grid_4x4", "Grid 4 x 4"},
    Row{"grid_4x4_true", "Grid 4 x 4, true rest lengths"},
    Row{"assignment", "Assignment"},
    Row{"unstable", "Unstable"},
    Row{"stable", "Stable"},
    Row{"drum_32", "Drum 32"},
    Row{"rope_64", "Rope 64"},
    Row{"cloth_32", "Cloth 32"},
};

bool is_inside(const fs::path& file, const fs::path& folder) {
  const fs::path way = file.lexically_relative(folder);
  return !way.empty() && *way.begin() != "..";
}

// A program in the build tree reads the source tree's scenes; an installed one those beside it, wherever the
// installation was moved to, and else those where it was to be installed.
fs::path find_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    if (is_inside(program, build_folder)) return fs::path(source_scenes);
    const fs::path beside = (program.parent_path() / scenes_from_programs).lexically_normal();
    if (fs::is_directory(beside, error)) return beside;
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
    for (const Row& row : rows) found.push_back({row.id, row.title, folder / (std::string(row.id) + ".json")});
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
