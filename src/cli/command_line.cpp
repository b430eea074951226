#include "cli/command_line.h"

#include <array>

#include "base/build_info.h"
#include "base/file_limits.h"
#include "cli/commands/commands.h"
#include "device/gpu_device.h"

namespace hooke {
namespace {

// Every subcommand, in the order of the help.
constexpr std::array subcommands{
    Subcommand{"run", "Simulate a scene and report the result", declare_run},
    Subcommand{"bench", "Measure speed and error of every method", declare_bench},
    Subcommand{"sweep", "Run a scene with many parameter values and tabulate results", declare_sweep},
    Subcommand{"capture", "Render a scene to pictures or video, without a display", declare_capture},
    Subcommand{"check", "Run the checks of scenes, or every method on the hard cases", declare_check},
    Subcommand{"convert", "Convert a scene file to another format", declare_convert},
    Subcommand{"replay", "Replay a recording made in the window", declare_replay},
};

std::string limits() {
  std::string text = "Limits of scene files; files beyond them are refused with exit code 3:\n";
  for (const FileLimit& row : file_limits()) text += "  " + std::string(row.what) + ": " + std::string(row.limit) + "\n";
  text.pop_back();
  return text;
}

void add_general_options(CLI::App& app) {
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.set_version_flag(
      "--version", [] { return "hooke-headless " + std::string(program_version) + "\n" + describe_gpu(); },
      "Print the version, and what --device gpu computes on, and exit");
  // thrown like the version, so that it takes precedence over other errors of the command line
  app.add_flag_callback(
      "--limits", [] { throw CLI::CallForVersion(limits(), 0); }, "Print the limits of scene files and exit");
}

}  // namespace

DeclaredCommands declare_command_line(CLI::App& app) {
  app.name("hooke-headless");
  app.description("Hooke without a window: networks of point masses and springs.");
  app.footer(
      "Results go to stdout or the named file, everything else to stderr.\n"
      "Exit codes: 0 success, 1 a check failed, 2 wrong usage, 3 input refused, 4 diverged, 5 a file could not be read or written.");
  add_general_options(app);
  app.require_subcommand(1);

  DeclaredCommands declared;
  for (const Subcommand& subcommand : subcommands) {
    CLI::App* sub = app.add_subcommand(subcommand.name, subcommand.summary);
    add_general_options(*sub);
    declared.emplace_back(sub, subcommand.declare(*sub));
  }
  return declared;
}

}  // namespace hooke
