#include "cli/commands/convert.h"

#include <iostream>

#include "base/printable.h"
#include "formats/open_file.h"

namespace hooke {
namespace {

struct ConvertOptions {
  std::string in, out;
  bool quiet = false;
};

int convert(const ConvertOptions& options) {
  const FileKind* kind = find_file_kind(options.out);
  if (kind == nullptr || kind->format == nullptr) throw UsageError(printable(options.out) + ": must end in " + writable_extensions());

  const LoadedScene loaded = load_file(find_scene(options.in));
  const std::vector<std::string> losses = write_scene_as(loaded.scene, options.out);
  if (options.quiet) return exit_code::success;
  for (const std::string& warning : loaded.warnings) std::cerr << "warning: " << warning << "\n";
  for (const std::string& what : losses) std::cerr << "warning: " << what << "\n";
  return exit_code::success;
}

}  // namespace

std::function<int()> declare_convert(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  app.add_option("IN", options->in, "A file (" + readable_extensions() + "), or the name of a shipped scene")->required();
  app.add_option("OUT", options->out, "The file to write (" + writable_extensions() + "); replaced only when complete")->required();
  app.add_flag("-q,--quiet", options->quiet, "Print no warnings");
  return [options] { return convert(*options); };
}

}  // namespace hooke
