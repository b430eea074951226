#include "app/files.h"

#include <algorithm>
#include <cstdlib>

#include "lab/scene_file.h"

namespace hooke {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text.append(text.empty() ? "" : "\n").append(line);
  return text;
}

Opened try_open(const std::filesystem::path& file) {
  try {
    LoadedScene loaded = load_scene(file);
    return {std::make_shared<const Scene>(std::move(loaded.scene)), {}, joined(loaded.warnings)};
  } catch (const std::runtime_error& refusal) {  // Refused or FileError
    return {nullptr, refusal.what(), {}};
  }
}

std::string try_save(const Scene& scene, const std::filesystem::path& file) {
  try {
    save_scene(scene, file);
    return {};
  } catch (const FileError& error) {
    return error.what();
  }
}

std::filesystem::path typed_path(const std::filesystem::path& typed) {
  std::filesystem::path path = typed;
  const char* home = std::getenv("HOME");
  if (home != nullptr && path.string().starts_with("~/")) path = std::filesystem::path(home) / path.string().substr(2);
  if (!path.has_extension()) path += ".json";
  std::error_code error;
  const std::filesystem::path full = std::filesystem::absolute(path, error);
  return error ? path : full.lexically_normal();
}

bool is_shipped(const std::filesystem::path& file) {
  const auto& scenes = shipped_scenes();
  return std::ranges::find(scenes, file, &ShippedScene::file) != scenes.end();
}

}  // namespace hooke
