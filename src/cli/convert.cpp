#include "cli/convert.h"

#include <iostream>

#include "lab/printable.h"
#include "lab/scene_file.h"

namespace hooke {
namespace {

struct ConvertOptions {
  std::string in, out;
  bool quiet = false;
};

void check_kind(const std::filesystem::path& file) {
  if (file.extension() != ".json")
    throw UsageError(printable(file.native()) + ": must end in .json, the kind of file that can be converted");
}

int convert(const ConvertOptions& options) {
  const std::filesystem::path in = find_scene(options.in);
  check_kind(in);
  check_kind(options.out);
  const LoadedScene loaded = load_scene(in);
  if (!options.quiet)
    for (const std::string& warning : loaded.warnings) std::cerr << "warning: " << warning << "\n";
  save_scene(loaded.scene, options.out);
  return exit_code::fine;
}

}  // namespace

std::function<int()> declare_convert(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  app.add_option("IN", options->in, "A scene file (.json), or the name of one that ships")->required();
  app.add_option("OUT", options->out, "The file to write (.json): whole or not at all")->required();
  app.add_flag("-q,--quiet", options->quiet, "No warnings");
  return [options] { return convert(*options); };
}

}  // namespace hooke
