// hooke-headless: the commands that need no window.

#include <iostream>

#include "base/errors.h"
#include "base/printable.h"
#include "batch/output_file.h"
#include "cli/command_line.h"

namespace hooke {
namespace {

int report(const std::string& what, int code) {
  std::cerr << "hooke-headless: " << what << "\n";
  return code;
}

int handle(int argc, char** argv) {
  CLI::App app;
  const DeclaredCommands declared = declare_command_line(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help, version or limits, printed to stdout
    return report(printable(error.what()) + " (see --help)", exit_code::wrong_usage);
  }
  for (const auto& [sub, work] : declared)
    if (sub->parsed()) return work();
  return exit_code::wrong_usage;
}

}  // namespace
}  // namespace hooke

int main(int argc, char** argv) {
  using namespace hooke;
  try {
    const int code = handle(argc, argv);
    flush_stdout();
    return code;
  } catch (const UsageError& error) {
    return report(error.what(), exit_code::wrong_usage);
  } catch (const InputError& error) {
    return report(error.what(), exit_code::refused);
  } catch (const FileError& error) {
    return report(error.what(), exit_code::file_error);
  } catch (const std::exception& error) {
    return report(error.what(), exit_code::file_error);
  }
}
