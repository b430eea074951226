#include "formats/open_file.h"

#include "base/atomic_write.h"
#include "base/printable.h"
#include "base/read_file.h"

namespace hooke {

LoadedScene load_file(const std::filesystem::path& file, const Progress& progress) {
  const FileKind* kind = find_file_kind(file);
  if (kind == nullptr || kind->is_native) return load_scene(file, progress);
  const std::string name = printable(file.native());
  if (kind->parse == nullptr)
    throw InputError(name + ": file format: " + std::string(kind->extension) + ": can only be written: must be " + readable_extensions());
  return kind->parse(read_file(file), name);
}

std::vector<std::string> write_scene_as(const Scene& scene, const std::filesystem::path& file) {
  const FileKind* kind = find_file_kind(file);
  const std::string name = printable(file.native());
  if (kind == nullptr || kind->format == nullptr)
    throw InputError(name + ": file format: \"" + printable(file.extension().native()) + "\": must be " + writable_extensions());
  std::vector<std::string> losses;
  const std::string text = kind->format(scene, name, losses);
  if (kind->format_companion != nullptr)
    write_atomically(std::filesystem::path(file).replace_extension(kind->companion_extension), kind->format_companion(scene));
  write_atomically(file, text);
  return losses;
}

}  // namespace hooke
