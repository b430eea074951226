#include "cli/manual/completion.h"

#include <sstream>

#include "cli/command_line.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "scene/quantity.h"
#include "sim/control/automatic.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

Words methods() {
  Words ids{std::string(automatic_method().id)};
  for (const Integrator& integrator : integrators()) ids.emplace_back(integrator.id);
  return ids;
}

Words scenes() {
  Words ids;
  for (const ShippedScene& scene : shipped_scenes()) ids.push_back(scene.id);
  return ids;
}

// "stiffness=", and "damped_springs=on" where the values are words.
Words settings() {
  Words words;
  for (const Parameter& parameter : parameters()) {
    const std::string start = std::string(parameter.name) + "=";
    if (parameter.kind == Parameter::Kind::Switch)
      words.insert(words.end(), {start + "on", start + "off"});
    else if (parameter.choices.empty())
      words.push_back(start);
    for (const ParameterChoice& choice : parameter.choices) words.push_back(start + std::string(choice.id));
  }
  return words;
}

// The names of the quantities of a sample, or of a run if `over_time`. Names such as x<point> are not completed.
Words quantities(bool over_time) {
  Words words;
  for (const char* of : {"", "max:", "min:", "mean:"})
    for (const QuantityRow& row : quantity_rows())
      if ((over_time || *of == '\0') && row.name.find('<') == std::string_view::npos) words.push_back(of + std::string(row.name));
  if (over_time) words.emplace_back("cpu");
  return words;
}

// What completes the value of an option, as the table has it.
struct Values {
  std::string kind;
  Words words{};
};

Values values_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return {"flag"};
  if (option.check_name("--integrator")) return {"words", methods()};
  if (option.check_name("--methods")) return {"list", methods()};
  if (option.check_name("--set")) return {"words", settings()};
  if (option.check_name("--vary")) return {"list", settings()};
  if (option.check_name("--measure")) return {"list", quantities(true)};
  if (option.check_name("--quantities")) return {"list", quantities(false)};
  const std::string type = option.get_type_name();
  for (const char* file : {"FILE", "DIR", "LOG", ".json"})
    if (type.find(file) != std::string::npos) return {"files"};
  if (type.find('|') == std::string::npos) return {"value"};
  Values values{"words"};
  std::istringstream words(type);
  for (std::string word; std::getline(words, word, '|');) values.words.push_back(word);
  return values;
}

Words names_of(const CLI::Option& option) {
  Words names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

}  // namespace

std::string completion_table() {
  CLI::App app;
  const DeclaredCommands commands = declare_command_line(app);
  std::ostringstream table;
  table << "scenes\t" << joined(scenes()) << "\ngeneral\t";
  for (const CLI::Option* option : app.get_options()) table << joined(names_of(*option)) << " ";
  table << "\n";
  for (const auto& [command, work] : commands) {
    table << "command\t" << command->get_name() << "\t" << command->get_description() << "\n";
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_positional()) continue;
      const auto [kind, words] = values_of(*option);
      table << "option\t" << command->get_name() << "\t" << joined(names_of(*option)) << "\t" << kind << "\t" << joined(words) << "\t"
            << option->get_description() << "\n";
    }
  }
  return table.str();
}

}  // namespace hooke
