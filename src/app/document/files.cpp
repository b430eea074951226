#include "app/document/files.h"

#include <algorithm>

#include "base/folder_listing.h"
#include "base/number_text.h"
#include "base/printable.h"
#include "device/gpu_device.h"
#include "formats/open_file.h"
#include "formats/scene_check.h"
#include "formats/scene_file.h"
#include "formats/texture.h"

namespace hooke {
namespace {

std::filesystem::path without_tilde(const std::filesystem::path& typed) {
  return typed.string().starts_with("~/") ? home_folder() / typed.string().substr(2) : typed;
}

}  // namespace

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text.append(text.empty() ? "" : "\n").append(line);
  return text;
}

std::string opening_notice(const Scene& scene, const std::vector<std::string>& warnings, const std::filesystem::path& file) {
  if (!warnings.empty() && check_of(scene).expects_divergence) return scene.description;
  const std::string prefix = printable(file.native()) + ": ";
  std::vector<std::string> lines;
  for (const std::string& warning : warnings) lines.push_back(warning.starts_with(prefix) ? warning.substr(prefix.size()) : warning);
  return joined(lines);
}

LoadedScene load_fitting(const std::filesystem::path& file, const Progress& progress, const ImportOptions& options) {
  const std::filesystem::path large = is_shipped(file) ? file.parent_path() / "large" / file.filename() : std::filesystem::path();
  std::error_code error;
  if (!std::filesystem::exists(large, error)) return load_file(file, progress, options);
  const bool is_fit = has_graphics_card();
  LoadedScene loaded = load_file(is_fit ? large : file, progress, options);
  loaded.warnings.push_back(is_fit ? "Its speed is that of a graphics card: set Compute on to GPU."
                                   : "Opened with " + number_text(loaded.scene.system.point_count()) +
                                         " points: all of them need a graphics card with OpenGL 4.3.");
  return loaded;
}

Opened try_open(const std::filesystem::path& file, const Progress& progress, const ImportOptions& options) {
  try {
    LoadedScene loaded = load_fitting(file, progress, options);
    std::string notice = opening_notice(loaded.scene, loaded.warnings, file);
    return {std::make_shared<const Scene>(std::move(loaded.scene)), {}, std::move(notice), std::move(loaded.summary)};
  } catch (const std::runtime_error& refusal) {  // InputError or FileError
    return {nullptr, refusal.what(), {}, {}};
  }
}

std::string try_save(const Scene& scene, const std::filesystem::path& file, const Progress& progress) {
  try {
    save_scene(scene, file, progress);
    return {};
  } catch (const FileError& error) {
    return error.what();
  }
}

ChosenTexture try_texture(const std::string& typed, const std::filesystem::path& document) {
  if (typed.empty()) return {};
  const bool ships = std::ranges::any_of(shipped_textures(), [&](const ShippedTexture& row) { return row.id == typed; });
  if (!ships && (document.empty() || is_shipped(document)))
    return {{}, "A texture must be in the folder of its scene: save the scene there first."};

  // the path relative to the document
  const std::filesystem::path folder = document.parent_path();
  std::string texture = typed;
  if (!ships) {
    std::error_code error;
    const std::filesystem::path path = without_tilde(typed), full = std::filesystem::absolute(folder, error) / path;
    texture = full.lexically_normal().lexically_relative(std::filesystem::absolute(folder, error).lexically_normal()).string();
  }
  const std::string name = "texture: \"" + printable(texture) + "\"";
  if (const std::string limit = texture_limit(texture); !limit.empty()) return {{}, name + ": " + limit + ", " + folder.string()};
  try {
    return {{.texture = texture, .image = {read_texture(texture, folder, name)}}, {}};
  } catch (const std::runtime_error& refusal) {  // InputError or FileError
    return {{}, refusal.what()};
  }
}

std::filesystem::path typed_path(const std::filesystem::path& typed) {
  std::error_code error;
  return resolve_typed_path(typed, std::filesystem::current_path(error));
}

std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& stem, const std::string& extension) {
  std::error_code error;
  for (int number = 1;; ++number) {
    std::filesystem::path file = folder / (stem + (number == 1 ? "" : " " + std::to_string(number)) + extension);
    if (!std::filesystem::exists(file, error)) return file;
  }
}

bool is_shipped(const std::filesystem::path& file) {
  const auto& scenes = shipped_scenes();
  return std::ranges::find(scenes, file, &ShippedScene::file) != scenes.end();
}

}  // namespace hooke
