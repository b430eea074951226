// Prints the man page or the completion for a shell, or updates the generated tables of pages: make_manual man|bash|zsh|fish|docs FILE...
#include <fstream>
#include <iostream>
#include <sstream>
#include <string_view>

#include "base/build_info.h"
#include "cli/command_line.h"
#include "cli/manual/completion.h"
#include "formats/doc_tables.h"
#include "formats/open_file.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "sim/methods/integrator.h"
#include "ui/shortcuts.h"

namespace hooke {
namespace {

// Escapes text for roff: backslashes, minus signs that can be copied, lines that look like requests.
std::string roff(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    const bool at_start = safe.empty() || safe.back() == '\n';
    if (at_start && (c == '.' || c == '\'')) safe += "\\&";
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
  }
  return safe;
}

void section(std::ostream& page, std::string_view title) { page << ".SH " << title << "\n"; }

// A term with its indented description.
void entry(std::ostream& page, std::string_view term, std::string_view description) {
  page << ".TP\n.B " << roff(term) << "\n" << roff(description) << "\n";
}

// "-q, --quiet", "--size WxH"; a positional by its name.
std::string term_of(const CLI::Option& option) {
  std::string term = option.get_positional() ? option.get_name(true) : option.get_name(false, true);
  for (std::size_t comma = 0; (comma = term.find(',', comma)) != std::string::npos; comma += 2) term.insert(comma + 1, " ");
  const bool takes_value = !option.get_positional() && option.get_items_expected_max() > 0;
  return takes_value && !option.get_type_name().empty() ? term + " " + option.get_type_name() : term;
}

bool is_general(const CLI::Option& option) {
  for (const char* name : {"--help", "--version", "--limits"})
    if (option.check_name(name)) return true;
  return false;
}

void write_options(std::ostream& page, const CLI::App& app, bool general) {
  for (const CLI::Option* option : app.get_options())
    if (is_general(*option) == general) entry(page, term_of(*option), option->get_description());
}

// The arguments of a command, abbreviated.
std::string synopsis_of(const CLI::App& app) {
  std::string line;
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name = option->get_name(true) + (option->get_items_expected_max() > 1 ? " ..." : "");
    line += option->get_required() ? " " + name : " [" + name + "]";
  }
  return line + " [OPTIONS]";
}

void write_keys(std::ostream& page) {
  std::string_view group;
  for (const Shortcut& shortcut : shortcuts()) {
    if (shortcut.group != group) page << ".SS " << roff(group = shortcut.group) << "\n";
    entry(page, key_text(shortcut), shortcut.text);
  }
  page << ".SS Mouse\n";
  for (const MouseHint& hint : mouse_hints()) entry(page, hint.gesture, hint.text);
}

void write_parameters(std::ostream& page) {
  for (const Parameter& parameter : parameters()) {
    const std::string unit = parameter.unit.empty() ? "" : " [" + std::string(parameter.unit) + "]";
    entry(page, parameter.name, std::string(parameter.description) + unit);
  }
}

// ---- tables of the documentation

// Text in a cell of a Markdown table.
std::string cell(std::string_view text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? "\\|" : std::string(1, c);
  return safe;
}

std::string key_table() {
  std::string table = "| group | key | what it does |\n|---|---|---|\n";
  for (const Shortcut& shortcut : shortcuts())
    table += "| " + std::string(shortcut.group) + " | **" + cell(key_text(shortcut)) + "** | " + cell(shortcut.text) + " |\n";
  for (const MouseHint& hint : mouse_hints()) table += "| Mouse | " + cell(hint.gesture) + " | " + cell(hint.text) + " |\n";
  return table;
}

std::string option_table(const CLI::App& command) {
  std::string table = "| option | what it does |\n|---|---|\n";
  for (const CLI::Option* option : command.get_options())
    if (!is_general(*option)) table += "| `" + cell(term_of(*option)) + "` | " + cell(option->get_description()) + " |\n";
  return table;
}

std::string parameter_table() {
  std::string table = "| name | unit | meaning |\n|---|---|---|\n";
  for (const Parameter& row : parameters())
    table += "| `" + std::string(row.name) + "` | " + std::string(row.unit) + " | " + cell(row.description) + " |\n";
  return table;
}

// The page of the documentation with its tables of keys, options and parameters up to date, between the lines "<!-- table NAME -->" and
// "<!-- end -->", where NAME is keys, set, or the name of a command.
std::string with_manual_tables(std::string_view page) {
  CLI::App app;
  std::string text = with_table(std::string(page), "keys", key_table());
  text = with_table(text, "set", parameter_table());
  for (const auto& [command, work] : declare_command_line(app)) text = with_table(text, command->get_name(), option_table(*command));
  return text;
}

// hooke(1) in roff: commands and options as they are declared, keys, parameters, methods, exit codes.
std::string manual_page() {
  CLI::App app;
  const DeclaredCommands commands = declare_command_line(app);
  std::ostringstream page;
  page << ".TH HOOKE 1 \"\" \"hooke " << program_version << "\" \"User commands\"\n";
  section(page, "NAME");
  page << "hooke, hooke\\-headless \\- a laboratory for networks of point masses and springs\n";

  section(page, "SYNOPSIS");
  page << ".B hooke\n.RB [ \\-\\-reset\\-settings ]\n.RI [ SCENE ]\n";
  for (const auto& [command, work] : commands) {
    const std::string rest = synopsis_of(*command);
    page << ".br\n.B hooke " << command->get_name() << "\n" << roff(std::string_view(rest).substr(1)) << "\n";
  }

  section(page, "DESCRIPTION");
  page << "Hooke is a desktop laboratory for networks of point masses and springs. It estimates its errors and the\n"
          "cost of higher accuracy. Without a command it opens a window with SCENE: a file ("
       << roff(readable_extensions())
       << "), or the name of a shipped scene.\n"
          "The commands need no window and no display; they are those of\n.BR hooke\\-headless .\n";

  section(page, "OPTIONS");
  write_options(page, app, true);
  entry(page, "--from-desktop", "Show in the window why SCENE cannot be opened, where no terminal would show it.");
  entry(page, "--reset-settings", "Delete the saved settings of the window and start with the defaults.");
  for (const auto& [command, work] : commands) {
    page << ".SS hooke " << command->get_name() << "\n" << roff(command->get_description()) << ".\n";
    write_options(page, *command, false);
  }

  section(page, "KEYS");
  page << "In the window:\n";
  write_keys(page);

  section(page, "METHODS");
  entry(page, automatic_method().id, automatic_method().summary);
  for (const Integrator& integrator : integrators()) entry(page, integrator.id, integrator.summary);

  section(page, "PARAMETERS");
  page << "Parameters of a scene, set by a slider, in its file, or with\n.BR \\-\\-set :\n";
  write_parameters(page);

  section(page, "SCENES");
  page << "Shipped with Hooke:\n";
  for (const ShippedScene& scene : shipped_scenes()) entry(page, scene.id, scene.title);

  section(page, "EXIT STATUS");
  for (const auto& [code, description] : {std::pair{"0", "Success."},
                                          {"1", "A check failed."},
                                          {"2", "Wrong usage."},
                                          {"3", "The input was refused: one line names file, field, value and limit."},
                                          {"4", "The simulation diverged, or the tolerance was not met."},
                                          {"5", "A file could not be read or written."},
                                          {"130, 143", "Ctrl+C or SIGTERM: what was computed until then is written."}})
    entry(page, code, description);
  return page.str();
}

bool update_tables(const char* file) {
  std::ostringstream page;
  page << std::ifstream(file).rdbuf();
  const std::string text = with_manual_tables(with_doc_tables(page.str()));
  return static_cast<bool>(std::ofstream(file) << text << std::flush);
}

}  // namespace
}  // namespace hooke

int main(int count, char** arguments) {
  const std::string_view what = count >= 2 ? arguments[1] : "";
  if (what == "docs" && count > 2) {
    for (int i = 2; i < count; ++i)
      if (!hooke::update_tables(arguments[i])) return 5;
    return 0;
  }
  for (const auto& [name, text] : {std::pair{"man", &hooke::manual_page}, std::pair{"completion", &hooke::completion_table}})
    if (count == 2 && what == name) return std::cout << text() << std::flush ? 0 : 5;
  std::cerr << "usage: make_manual man|completion|docs FILE...\n";
  return 2;
}
