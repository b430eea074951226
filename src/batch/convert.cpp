#include "batch/convert.h"

#include "base/printable.h"
#include "formats/open_file.h"

namespace hooke {

LoadedScene convert_file(const std::string& in, const std::string& out, const ImportOptions& options) {
  const FileKind* kind = find_file_kind(out);
  if (kind == nullptr || kind->format == nullptr) throw UsageError(printable(out) + ": must end in " + writable_extensions());

  LoadedScene loaded = load_file(find_scene(in), {}, options);
  for (std::string& loss : write_scene_as(loaded.scene, out)) loaded.warnings.push_back(std::move(loss));
  return loaded;
}

}  // namespace hooke
