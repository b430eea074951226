// Opening and saving scenes, with errors as text.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "edit/command.h"
#include "formats/import_options.h"
#include "formats/scene_file.h"

namespace hooke {

// The lines, separated by newlines.
std::string joined(const std::vector<std::string>& lines);

// What the window says about a scene that was just opened: warnings about its file, without its path; or, where the scene is about
// instability, its lesson instead of the warning that it is unstable.
std::string opening_notice(const Scene& scene, const std::vector<std::string>& warnings, const std::filesystem::path& file);

// Where a shipped scene has a large version for graphics cards (assets/scenes/large), opens it if there is one, and else says how many points
// are missing. Throws InputError, FileError.
LoadedScene load_fitting(const std::filesystem::path& file, const Progress& progress = {}, const ImportOptions& options = {});

struct Opened {
  std::shared_ptr<const Scene> scene;  // null on error
  std::string error, warnings;         // lines
  std::string summary;                 // the size of a mesh
};
Opened try_open(const std::filesystem::path& file, const Progress& progress, const ImportOptions& options = {});

// Returns an error text, empty on success.
std::string try_save(const Scene& scene, const std::filesystem::path& file, const Progress& progress);

// A texture by name, if it is shipped, or by the path of a PNG file, which must be in the folder of the document.
struct ChosenTexture {
  SetTexture set;
  std::string error;  // empty on success
};
ChosenTexture try_texture(const std::string& typed, const std::filesystem::path& document);

// Resolves a typed path: "~/" is the home folder, the default extension is .json, and relative paths start at the working folder.
std::filesystem::path typed_path(const std::filesystem::path& typed);

// An unused file name in the folder: "cloth.png", "cloth 2.png", ...
std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& stem, const std::string& extension);

bool is_shipped(const std::filesystem::path& file);

}  // namespace hooke
