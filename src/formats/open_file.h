// Reads and writes scenes in any of the formats, by the extension of the file.
#pragma once

#include "formats/file_kind.h"

namespace hooke {

// A file without an extension is read as a JSON scene. For any bytes, throws nothing but InputError or FileError. Opens no other file
// except a texture in the folder of the file. Only scenes report progress. Throws InputError for options of meshes with another file.
LoadedScene load_file(const std::filesystem::path& file, const Progress& progress = {}, const ImportOptions& options = {});

// Writes the file atomically, after the second file of formats that have one. Returns what the format cannot represent. Throws InputError
// or FileError, and leaves the old file unchanged.
std::vector<std::string> write_scene_as(const Scene& scene, const std::filesystem::path& file);

// `in` is a file or the id of a shipped scene; the extension of `out` determines the format. Returns the scene as it was read, with
// warnings about the file, and about what the format cannot represent. Throws UsageError, InputError, FileError.
LoadedScene convert_file(const std::string& in, const std::string& out, const ImportOptions& options = {});

}  // namespace hooke
