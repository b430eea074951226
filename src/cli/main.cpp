// hooke-headless: everything that needs no window.

#include <array>
#include <iostream>

#include "cli/bench.h"
#include "cli/capture.h"
#include "cli/check.h"
#include "cli/convert.h"
#include "cli/run.h"
#include "lab/build_info.h"
#include "lab/file_limits.h"
#include "lab/printable.h"
#include "sim/errors.h"

namespace hooke {
namespace {

// Every subcommand, in the order of the help.
constexpr std::array subcommands{
    Subcommand{"run", "Step a scene and report what became of it", declare_run},
    Subcommand{"bench", "Measure the speed and the error of every method", declare_bench},
    Subcommand{"capture", "Draw a scene as it moves, with no display", declare_capture},
    Subcommand{"check", "Check the scenes; or every method on the hard cases", declare_check},
    Subcommand{"convert", "Write a scene file as another", declare_convert},
};

std::string limits() {
  std::string text = "What a scene file may be; anything else is refused with exit code 3:\n";
  for (const FileLimit& row : file_limits()) text += "  " + std::string(row.what) + ": " + std::string(row.limit) + "\n";
  text.pop_back();
  return text;
}

void add_general_options(CLI::App& app) {
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.set_version_flag("--version", "hooke-headless " + std::string(program_version), "Print the version and exit");
  // thrown like the version: before anything else that is wrong with the command line
  app.add_flag_callback(
      "--limits", [] { throw CLI::CallForVersion(limits(), 0); }, "Print the limits of scene files and exit");
}

int report(const std::string& what, int code) {
  std::cout.flush();
  std::cerr << "hooke-headless: " << what << "\n";
  return code;
}

int obey(int argc, char** argv) {
  CLI::App app("Hooke without a window: networks of point masses and springs.", "hooke-headless");
  app.footer(
      "Results go to stdout or the named file, everything else to stderr.\n"
      "Exit codes: 0 fine, 1 a check failed, 2 wrong usage, 3 input refused, 4 diverged, 5 a file could not be read or written.");
  add_general_options(app);
  app.require_subcommand(1);

  std::vector<std::pair<CLI::App*, std::function<int()>>> declared;
  for (const Subcommand& subcommand : subcommands) {
    CLI::App* sub = app.add_subcommand(subcommand.name, subcommand.summary);
    add_general_options(*sub);
    declared.emplace_back(sub, subcommand.declare(*sub));
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help, version or limits, on stdout
    return report(printable(error.what()) + " (--help tells more)", exit_code::wrong_usage);
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
    return obey(argc, argv);
  } catch (const UsageError& error) {
    return report(error.what(), exit_code::wrong_usage);
  } catch (const Refused& error) {
    return report(error.what(), exit_code::refused);
  } catch (const FileError& error) {
    return report(error.what(), exit_code::file_error);
  } catch (const std::exception& error) {
    return report(error.what(), exit_code::file_error);
  }
}
