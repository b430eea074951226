// Every kind of file that a scene can come from or go to, told by its ending.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/scene_file.h"

namespace hooke {

struct FileKind {
  std::string_view extension;  // ".json"
  std::string_view label;      // "Wavefront mesh"
  // From memory, `file` stands for it in messages; null where the kind is only written.
  LoadedScene (*parse)(std::string_view text, const std::string& file);
  // Appends to `lost` what the kind has no place for, one sentence each. Throws InputError.
  std::string (*format)(const Scene& scene, const std::string& file, std::vector<std::string>& losses);
};
std::span<const FileKind> file_kinds();

// By the path's ending, whatever its case; null when it is none of the table's.
const FileKind* find_file_kind(const std::filesystem::path& file);

// ".json, .xsp or .obj": the endings of what can be read, or of what can be written.
std::string readable_extensions();
std::string writable_extensions();

// True for the kind that keeps everything; saving as another kind is an export.
bool is_scene_file(const std::filesystem::path& file);

// Reads a file by its ending; one without a known ending as a scene in JSON. Throws InputError or FileError; never anything
// else, whatever the bytes. No file but this is opened, and a texture within its folder. Only a scene tells how far it is.
LoadedScene load_file(const std::filesystem::path& file, const Progress& progress = {});

// Writes a file by its ending, whole or not at all. Returns what the kind has no place for. Throws InputError or FileError;
// then the old file is as it was.
std::vector<std::string> write_scene_as(const Scene& scene, const std::filesystem::path& file);

}  // namespace hooke
