// Opening and saving the document, with errors as text.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "edit/command.h"

namespace hooke {

// One under the other.
std::string joined(const std::vector<std::string>& lines);

struct Opened {
  std::shared_ptr<const Scene> scene;  // null: refused
  std::string error, warnings;         // lines
};
Opened try_open(const std::filesystem::path& file, const Progress& progress);

// An error text, empty when it is saved.
std::string try_save(const Scene& scene, const std::filesystem::path& file, const Progress& progress);

// A texture as a person names it: one that ships, or a PNG by its path, which must lie in the folder of the document.
struct ChosenTexture {
  SetTexture set;
  std::string error;  // empty: fine
};
ChosenTexture try_texture(const std::string& typed, const std::filesystem::path& document);

// A path as a person types it: "~/" is the home folder, a missing ending is .json, the rest starts from the working folder.
std::filesystem::path typed_path(const std::filesystem::path& typed);

bool is_shipped(const std::filesystem::path& file);

}  // namespace hooke
