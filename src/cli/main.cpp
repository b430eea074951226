// hooke-headless: the commands that need no window.

#include <malloc.h>

#include <algorithm>
#include <cctype>
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

// CLI11 would only say that a command is required. The name is empty where there is none.
std::string why_no_command(const CLI::App& app, const std::string& name) {
  std::string names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names += (names.empty() ? "" : ", ") + command->get_name();
  if (!name.empty()) return printable(name, 80) + ": no such command: " + must_be_one_of(names, name);
  return "no command: must be one of " + names + ", as in hooke-headless run cloth --seconds 1";
}

// An option that the command does not have, which CLI11 would only report after a required one that is missing; empty: there is none.
std::string unknown_option(const CLI::App& command, int argc, char** argv) {
  for (int i = command.get_parent() == nullptr ? 1 : 2; i < argc; ++i) {
    const std::string word = argv[i], name = word.substr(0, word.find('='));
    const bool is_option = word.size() > 1 && word[0] == '-' && (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
    if (word == "--") break;
    if (!is_option) continue;
    if (const CLI::Option* known = command.get_option_no_throw(word[1] == '-' ? name : name.substr(0, 2))) {
      if (known->get_items_expected_max() > 0 && word == name) ++i;  // its value
      continue;
    }
    std::string names;
    for (const CLI::Option* option : command.get_options())
      for (const std::string& known : option->get_lnames()) names += (names.empty() ? "--" : ", --") + known;
    const std::string nearest = did_you_mean(names, name, 1);
    return printable(name, 80) + ": no such option" + (nearest.empty() ? "" : "; " + nearest);
  }
  return {};
}

std::string describe(const CLI::ParseError& error, const CLI::App& app, int argc, char** argv) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.front();
  if (std::string unknown = unknown_option(command, argc, argv); !unknown.empty()) return unknown;
  if (parsed.empty() && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return why_no_command(app, {});
  std::string what = printable(error.what());
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    std::string words;  // CLI11 reverses them
    for (const std::string& word : app.remaining(true)) words += (words.empty() ? "" : " ") + word;
    return "not expected: " + printable(words);
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return what.substr(0, what.find(' ')) + (what.ends_with(" missing") ? " its value is missing" : " must be given once");
  // other numbers and words are validated (within, one_of)
  constexpr std::string_view conversion = "Could not convert: ";
  const std::size_t equals = what.find(" = ");
  if (!what.starts_with(conversion) || equals == std::string::npos) return what;
  const std::string name = what.substr(conversion.size(), equals - conversion.size());
  const CLI::Option* option = command.get_option_no_throw(name);
  const bool is_flag = option != nullptr && option->get_items_expected_max() == 0;
  return name + ": " + what.substr(equals + 3) + (is_flag ? ": must have no value" : ": not a whole number");
}

int handle(int argc, char** argv) {
  CLI::App app;
  const DeclaredCommands declared = declare_command_line(app);
  const std::string first = argc > 1 && argv[1][0] != '-' ? argv[1] : "";
  if (!first.empty() && std::ranges::none_of(declared, [&](const auto& row) { return row.first->get_name() == first; }))
    return report(why_no_command(app, first) + " (see --help)", exit_code::wrong_usage);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help, version or limits, printed to stdout
    return report(describe(error, app, argc, argv) + " (see --help)", exit_code::wrong_usage);
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
  } catch (const std::exception& error) {  // FileError, or another failure of the system
    return report(error.what(), exit_code::file_error);
  }
}
