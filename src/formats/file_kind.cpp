#include "formats/file_kind.h"

#include <algorithm>
#include <cctype>

#include "base/text_lines.h"
#include "formats/file_kinds.h"

namespace hooke {
namespace {

std::string list_extensions(bool (*is_listed)(const FileKind& row)) {
  std::vector<std::string> listed;
  for (const FileKind& row : file_kinds())
    if (is_listed(row)) listed.emplace_back(row.extension);
  return joined(listed, {}, " or ");
}

}  // namespace

Table<FileKind> file_kinds() {
#define ROW(name) &name##_file,
  static constexpr const FileKind* rows[] = {
#include "formats/list.inc"
  };
#undef ROW
  return Table<FileKind>(rows);
}

Table<FileKind> export_kinds() {
  static const std::vector<const FileKind*> rows = [] {
    std::vector<const FileKind*> exports;
    for (const FileKind& kind : file_kinds())
      if (kind.source != ExportSource::None) exports.push_back(&kind);
    return exports;
  }();
  return Table<FileKind>(rows);
}

const FileKind* find_file_kind(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const FileKind& kind : file_kinds())
    if (kind.extension == extension) return &kind;
  return nullptr;
}

const FileKind* find_readable_kind(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return find_file_kind(extension == ".gz" || extension == ".GZ" ? file.stem() : file);
}

std::string readable_extensions() {
  return list_extensions([](const FileKind& row) { return row.parse != nullptr; });
}
std::string writable_extensions() {
  return list_extensions([](const FileKind& row) { return row.format != nullptr; });
}

bool is_scene_file(const std::filesystem::path& file) {
  const FileKind* kind = find_file_kind(file);
  return kind != nullptr && kind->is_native;
}

}  // namespace hooke
