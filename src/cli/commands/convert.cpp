#include "cli/commands/convert.h"

#include <iostream>

#include "batch/convert.h"
#include "formats/file_kind.h"

namespace hooke {
namespace {

struct ConvertOptions {
  std::string in, out;
  bool quiet = false;
};

int convert(const ConvertOptions& options) {
  const std::vector<std::string> warnings = convert_file(options.in, options.out);
  if (!options.quiet)
    for (const std::string& warning : warnings) std::cerr << "warning: " << warning << "\n";
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
