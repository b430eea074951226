#include "formats/open_file.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/atomic_write.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "formats/mesh_file.h"
#include "formats/xsp_file.h"

namespace hooke {
namespace {

using Losses = std::vector<std::string>;

// Meshes say where the points are and how they hang together: nothing else is asked of them.
constexpr std::array rows{
    FileKind{".json", "Hooke scene", parse_scene, [](const Scene& scene, const std::string&, Losses&) { return format_scene(scene); }},
    FileKind{".xsp", "XSpringies scene", parse_xsp, format_xsp},
    FileKind{".obj", "Wavefront mesh", parse_obj, [](const Scene& scene, const std::string&, Losses&) { return format_obj(scene); }},
    FileKind{".ply", "Stanford mesh with strain", nullptr,
             [](const Scene& scene, const std::string&, Losses&) { return format_ply(scene); }},
};

std::string list_extensions(bool (*is_listed)(const FileKind& row)) {
  std::string list;
  std::string_view last;
  for (const FileKind& row : rows) {
    if (!is_listed(row)) continue;
    if (!last.empty()) list += (list.empty() ? "" : ", ") + std::string(last);
    last = row.extension;
  }
  return list + (list.empty() ? "" : " or ") + std::string(last);
}

}  // namespace

std::span<const FileKind> file_kinds() { return rows; }

const FileKind* find_file_kind(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const FileKind& kind) { return kind.extension == extension; });
  return row == rows.end() ? nullptr : &*row;
}

std::string readable_extensions() {
  return list_extensions([](const FileKind& row) { return row.parse != nullptr; });
}
std::string writable_extensions() {
  return list_extensions([](const FileKind& row) { return row.format != nullptr; });
}

bool is_scene_file(const std::filesystem::path& file) { return find_file_kind(file) == &rows[0]; }

LoadedScene load_file(const std::filesystem::path& file, const Progress& progress) {
  const FileKind* kind = find_file_kind(file);
  if (!kind || is_scene_file(file)) return load_scene(file, progress);
  const std::string name = printable(file.native());
  if (!kind->parse)
    throw InputError(name + ": kind of file: " + std::string(kind->extension) + ": is only written: must be " + readable_extensions() +
                     " to be read");
  return kind->parse(read_file(file), name);
}

std::vector<std::string> write_scene_as(const Scene& scene, const std::filesystem::path& file) {
  const FileKind* kind = find_file_kind(file);
  const std::string name = printable(file.native());
  if (!kind) throw InputError(name + ": kind of file: \"" + printable(file.extension().native()) + "\": must be " + writable_extensions());
  std::vector<std::string> losses;
  write_atomically(file, kind->format(scene, name, losses));
  return losses;
}

}  // namespace hooke
