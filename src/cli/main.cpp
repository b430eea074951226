// hooke-headless: the commands that need no window.

#include <malloc.h>

#include <iostream>

#include "base/errors.h"
#include "base/option_error.h"
#include "base/printable.h"
#include "batch/output_file.h"
#include "cli/command_line.h"

namespace hooke {
namespace {

// A long block is given back when it is freed, even between others. The C library learns from the first of up to 32 MiB to keep those after
// it: a cloth of 4 million springs then takes 18 bytes per spring more. Pictures set limits of their own (draw/gl/gl.cpp).
void give_back_long_blocks() {
#ifdef __GLIBC__
  constexpr int long_block = 4 << 20;
  mallopt(M_MMAP_THRESHOLD, long_block);
  mallopt(M_TRIM_THRESHOLD, long_block);
#endif
}

int report(const std::string& what, int code) {
  std::cerr << "hooke-headless: " << without_middle(what) << "\n";
  return code;
}

// CLI11 would only say that a command is required.
void check_command(const std::string& name, const DeclaredCommands& declared) {
  std::string names;
  for (const auto& [sub, work] : declared) {
    if (sub->get_name() == name) return;
    names += (names.empty() ? "" : ", ") + sub->get_name();
  }
  throw UsageError(printable(name, 80) + ": no such command: " + must_be_one_of(names, name) + " (see --help)");
}

int handle(int argc, char** argv) {
  CLI::App app;
  const DeclaredCommands declared = declare_command_line(app);
  if (const std::string first = argc > 1 ? argv[1] : ""; !first.empty() && first[0] != '-') check_command(first, declared);
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
  give_back_long_blocks();
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
