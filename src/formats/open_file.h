// Reads and writes scenes in any of the formats, by the extension of the file.
#pragma once

#include "formats/file_kind.h"

namespace hooke {

// A file without a known extension is read as a scene in JSON. Throws InputError or FileError, nothing else, whatever the bytes.
// Opens no other file but a texture in the folder of the file. Only a scene reports progress.
LoadedScene load_file(const std::filesystem::path& file, const Progress& progress = {});

// Writes the file atomically. Returns what the format cannot represent. Throws InputError or FileError, and leaves the old
// file unchanged.
std::vector<std::string> write_scene_as(const Scene& scene, const std::filesystem::path& file);

}  // namespace hooke
