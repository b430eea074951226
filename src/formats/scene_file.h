// Scenes as JSON files (docs/reference/scene-format.md).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.h"
#include "base/progress.h"
#include "scene/scene.h"

namespace hooke {

struct LoadedScene {
  Scene scene;
  std::vector<std::string> warnings;  // one line each: unknown keys, coincident points, an explicit step beyond its limit
  std::string summary;                // one line, of a mesh: its size
};

// Reads a scene. For any bytes, throws nothing but InputError or FileError; InputError if `progress` cancels it.
LoadedScene load_scene(const std::filesystem::path& file, const Progress& progress = {});

// Reads a copy of `original` in another folder: textures are in the folder of the original.
LoadedScene load_scene_from_copy(const std::filesystem::path& copy, const std::filesystem::path& original, const Progress& progress = {});

// The same from memory; `name` is the file in messages.
LoadedScene parse_scene(std::string_view text, const std::string& name, const Progress& progress);
LoadedScene parse_scene(std::string_view text, const std::string& name);

// Members of a scene file without braces, as additions to `scene`: lists of parts, gravity, wind, simulation, contact and other parameters.
// What they leave out of these is as in `scene`. Throws InputError also for any other member, and for unknown ones.
Scene parse_members(std::string_view members, const std::string& name, const Scene& scene);

// The scene as JSON, which reads back as the same scene, bit for bit. Generators are kept if their points and springs are
// unchanged.
std::string format_scene(const Scene& scene, const Progress& progress = {});

// Writes atomically (base/atomic_write.h). Throws FileError, also if `progress` cancels it, and leaves the old file
// unchanged.
void save_scene(const Scene& scene, const std::filesystem::path& file, const Progress& progress = {});

// A shipped scene: a file in assets/scenes with a "gallery" entry.
struct ShippedScene {
  std::string id;           // "cloth", the name of the file
  std::string title;        // "Cloth"
  std::string description;  // what to try, and what to expect
  std::filesystem::path file;
  std::string group;  // "Lessons"
  int order = 0;
  double thumbnail_seconds = 0.0;  // [s], when its thumbnail is taken
};

// In the order of the menu and the gallery, group by group. Read once.
const std::vector<ShippedScene>& shipped_scenes();

// The folder of scenes, textures and thumbnails, of the installation or the source tree.
const std::filesystem::path& assets_folder();

// The file for SCENE on a command line: a path to an existing file, or the id of a shipped scene. Throws FileError, which also lists the
// commands that could have been meant in its place.
std::filesystem::path find_scene(const std::string& name, std::span<const std::string_view> commands = {});

}  // namespace hooke
