// Finds the shipped scenes. Their titles, groups and order are in their files.

#include <algorithm>
#include <optional>
#include <system_error>

#include "base/build_info.h"
#include "base/json_field.h"
#include "base/json_text.h"
#include "base/option_error.h"
#include "base/own_library.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "formats/file_kind.h"
#include "formats/gallery.h"
#include "formats/scene_file.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// The folder of the shipped scenes: beside the installed or built program or library, wherever it was moved; else the configured one.
fs::path find_folder() {
  std::error_code error;
  const fs::path library = own_library(), beside = library.empty() ? fs::read_symlink("/proc/self/exe", error) : library;
  const fs::path scenes = fs::path("share") / "hooke" / "scenes";
  for (fs::path folder = beside.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    if (fs::is_directory(folder / scenes, error)) return folder / scenes;
  return fs::path(installed_scenes);
}

// A scene of the gallery; none: the file has no gallery entry, or cannot be read.
std::optional<ShippedScene> read_listed(const fs::path& file) {
  ShippedScene scene{.id = file.stem().string(), .file = file};
  std::optional<GalleryEntry> entry;
  const std::string name = printable(file.native());
  try {
    const std::string text = read_file(file);
    JsonParser parser;
    const auto read_member = [&](std::string_view key, std::string_view value) {
      if (key != "name" && key != "description" && key != "gallery") return;
      const JsonField field(name, key, parser.parse(value));
      if (key == "name")
        scene.title = field.text();
      else if (key == "description")
        scene.description = field.text();
      else
        entry = read_gallery_entry(field);
    };
    walk_json(text, name,
              {.is_list = [](std::string_view) { return false; },
               .item = [](std::string_view, std::size_t, std::string_view) {},
               .member = read_member});
  } catch (const std::runtime_error&) {  // InputError or FileError: opening the scene reports it
    return std::nullopt;
  }
  if (!entry) return std::nullopt;
  scene.group = entry->group;
  scene.order = entry->order;
  scene.thumbnail_seconds = entry->thumbnail_seconds;
  return scene;
}

std::string ids() {
  std::string list;
  for (const ShippedScene& scene : shipped_scenes()) list += (list.empty() ? "" : ", ") + scene.id;
  return list;
}

// Similar files in the folder of a file, or similar choices.
std::string nearest_names(const fs::path& name, const std::string& choices) {
  constexpr std::size_t max_names = 3, max_files = 1000;
  if (name.has_parent_path() || name.has_extension()) {
    std::string files;
    std::size_t count = 0;
    std::error_code error;
    for (fs::directory_iterator entry(name.has_parent_path() ? name.parent_path() : ".", error), end;
         !error && entry != end && count < max_files; entry.increment(error), ++count)
      if (const std::string file = printable(entry->path().filename().native()); file.find(',') == std::string::npos)
        files += (files.empty() ? "" : ", ") + file;
    if (std::string nearest = did_you_mean(files, name.filename().native(), max_names); !nearest.empty()) return nearest;
  }
  return did_you_mean(choices, name.stem().native(), max_names);
}

}  // namespace

const fs::path& assets_folder() {
  static const fs::path folder = find_folder().parent_path();
  return folder;
}

const std::vector<ShippedScene>& shipped_scenes() {
  static const std::vector<ShippedScene> scenes = [] {
    std::vector<ShippedScene> found;
    std::error_code error;
    for (fs::directory_iterator entry(assets_folder() / "scenes", error), end; !error && entry != end; entry.increment(error))
      if (entry->path().extension() == ".json")
        if (auto scene = read_listed(entry->path())) found.push_back(std::move(*scene));
    std::ranges::sort(found, {}, [](const ShippedScene& scene) { return std::pair(scene.order, scene.id); });
    return found;
  }();
  return scenes;
}

fs::path find_scene(const std::string& name, std::span<const std::string_view> commands) {
  std::error_code error;
  const fs::file_status status = fs::status(name, error);
  if (!fs::exists(status) || fs::is_directory(status))
    for (const ShippedScene& scene : shipped_scenes())
      if (scene.id == name) return scene.file;
  if (fs::exists(status)) return name;
  if (commands.empty() && shipped_scenes().empty())
    throw MissingFileError(printable(name) + ": no such file, and no shipped scenes in " +
                           printable((assets_folder() / "scenes").native()));
  const bool is_file_name = name.find('/') != std::string::npos || (fs::path(name).has_extension() && find_file_kind(name) != nullptr);
  std::string choices;
  for (const std::string_view command : commands) choices.append(command).append(", ");
  choices += ids();
  // the nearest names first: the list is long
  const std::string nearest = nearest_names(name, choices);
  if (is_file_name) throw MissingFileError(printable(name) + ": no such file" + (nearest.empty() ? "" : "; " + nearest));
  throw MissingFileError(printable(name) +
                         (commands.empty() ? ": no such file or shipped scene" : ": no such command, file or shipped scene") +
                         (nearest.empty() ? ": must be one of " : "; " + nearest + " All names: ") + choices);
}

}  // namespace hooke
