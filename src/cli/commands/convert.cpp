#include "cli/commands/commands.h"

#include "cli/scene_options.h"
#include "formats/file_kind.h"
#include "formats/open_file.h"

namespace hooke {
namespace {

struct ConvertOptions {
  std::string in, out;
  ImportOptions import;
  bool quiet = false;
};

int convert(const ConvertOptions& options) {
  const LoadedScene loaded = convert_file(options.in, options.out, options.import);
  if (!options.quiet) print_notes(loaded);
  return exit_code::success;
}

}  // namespace

std::function<int()> declare_convert(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  app.add_option("IN", options->in, "A file (" + readable_extensions() + "), or the name of a shipped scene")->required();
  app.add_option("OUT", options->out, "The file to write (" + writable_extensions() + "); replaced only when complete")->required();
  add_import_options(app, options->import);
  app.add_flag("-q,--quiet", options->quiet, "Print no warnings");
  return [options] { return convert(*options); };
}

}  // namespace hooke
