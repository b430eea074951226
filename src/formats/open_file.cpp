#include "formats/open_file.h"

#include "base/atomic_write.h"
#include "base/printable.h"
#include "base/read_file.h"

namespace hooke {

LoadedScene load_file(const std::filesystem::path& file, const Progress& progress, const ImportOptions& options) {
  const FileKind* kind = find_readable_kind(file);
  const std::string name = printable(file.native());
  if (options != ImportOptions() && (kind == nullptr || !kind->is_mesh)) throw InputError(name + ": weld, scale and up: only of a mesh");
  if (kind == nullptr ? !file.has_extension() : kind->is_native) return load_scene(file, progress);
  const auto refuse = [&](const std::string& reason) {
    throw InputError(name + ": file format: " + printable(file.extension().native()) + ": " + reason + readable_extensions());
  };
  if (kind != nullptr && kind->parse == nullptr) refuse("can only be written: must be ");
  const std::string text = read_text_file(file);
  // a scene under another name
  if (const std::size_t first = text.find_first_not_of(" \t\r\n"); kind == nullptr && first != std::string::npos && text[first] == '{')
    return load_scene(file, progress);
  if (kind == nullptr) refuse("must be ");
  return kind->parse(text, name, options);
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

LoadedScene convert_file(const std::string& in, const std::string& out, const ImportOptions& options) {
  const FileKind* kind = find_file_kind(out);
  if (kind == nullptr || kind->format == nullptr) throw UsageError(printable(out) + ": must end in " + writable_extensions());

  LoadedScene loaded = load_file(find_scene(in), {}, options);
  for (std::string& loss : write_scene_as(loaded.scene, out)) loaded.warnings.push_back(std::move(loss));
  return loaded;
}

}  // namespace hooke
