#include "cli/manual/completion.h"

#include <map>
#include <sstream>

#include "cli/command_line.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
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

struct Values {
  Words words{};
  bool are_files = false;
};

// What completes the value of an option.
Values values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (option.check_name("--integrator") || option.check_name("--methods")) return {methods()};
  if (option.check_name("--set") || option.check_name("--vary")) return {settings()};
  for (const char* file : {"FILE", "DIR", "LOG", ".json"})
    if (type.find(file) != std::string::npos) return {{}, true};
  if (type.find('|') == std::string::npos) return {};
  Values values;
  std::istringstream words(type);
  for (std::string word; std::getline(words, word, '|');) values.words.push_back(word);
  return values;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

Words names_of(const CLI::Option& option) {
  Words names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string names_of_options(const CLI::App& app) {
  Words names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : names_of(*option)) names.push_back(name);
  return joined(names);
}

// In single quotes of a shell; `extra` characters get a backslash.
std::string in_quotes(std::string_view text, std::string_view extra = "") {
  std::string safe;
  for (const char c : text) {
    if (extra.find(c) != std::string_view::npos) safe += '\\';
    safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return "'" + safe + "'";
}

}  // namespace

std::string bash_completion() {
  CLI::App app;
  const DeclaredCommands commands = declare_command_line(app);
  Words names;
  std::map<std::string, std::string> by_values;  // names of options, by how their value is completed
  for (const auto& [command, work] : commands) {
    names.push_back(command->get_name());
    for (const CLI::Option* option : command->get_options()) {
      const Values values = values_of(*option);
      if (!takes_value(*option) || (values.words.empty() && !values.are_files)) continue;
      std::string& pattern =
          by_values[values.are_files ? "_filedir" : "COMPREPLY=($(compgen -W '" + joined(values.words) + "' -- \"$cur\"))"];
      for (const std::string& name : names_of(*option))
        if (("|" + pattern + "|").find("|" + name + "|") == std::string::npos) pattern += (pattern.empty() ? "" : "|") + name;
    }
  }

  std::ostringstream script;
  script << "# bash completion of hooke and hooke-headless\n"
            "_hooke() {\n"
            "  local cur prev words cword\n"
            "  _init_completion -n = || return\n"
            "  case $prev in\n";
  for (const auto& [action, pattern] : by_values)
    script << "    " << pattern << ") " << action << "; [[ ${COMPREPLY-} == *= ]] && compopt -o nospace; return ;;\n";
  script << "  esac\n"
            "  local options\n"
            "  case ${words[1]} in\n";
  for (const auto& [command, work] : commands)
    script << "    " << command->get_name() << ") options='" << names_of_options(*command) << "' ;;\n";
  script << "    *) options='" << names_of_options(app)
         << " --from-desktop --reset-settings' ;;\n"
            "  esac\n"
            "  case $cur in\n"
            "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$cur\")); return ;;\n"
            "  esac\n"
            "  _filedir\n"
            "  COMPREPLY+=($(compgen -W '"
         << joined(scenes())
         << "' -- \"$cur\"))\n"
            "  [ \"$cword\" -gt 1 ] || COMPREPLY+=($(compgen -W '"
         << joined(names)
         << "' -- \"$cur\"))\n"
            "}\n"
            "complete -F _hooke hooke hooke-headless\n";
  return script.str();
}

std::string zsh_completion() {
  CLI::App app;
  const DeclaredCommands commands = declare_command_line(app);
  std::ostringstream script;
  script << "#compdef hooke hooke-headless\n"
            "_hooke_scenes() {\n  _alternative 'scenes:scene:("
         << joined(scenes()) << ")' 'files:file:_files'\n}\n"
         << "_hooke() {\n  local -a commands=(";
  for (const auto& [command, work] : commands) script << "\n    " << in_quotes(command->get_name() + ":" + command->get_description());
  script << "\n  )\n"
            "  if (( CURRENT == 2 )); then\n    _describe command commands\n    _hooke_scenes\n    return\n  fi\n"
            "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n";
  for (const auto& [command, work] : commands) {
    script << "    " << command->get_name() << ") _arguments -S";
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_positional()) continue;
      const Values values = values_of(*option);
      // a number has no completion
      const std::string value = !takes_value(*option) ? ""
                                                      : ":value:" + (values.are_files       ? "_files"
                                                                     : values.words.empty() ? " "
                                                                                            : "(" + joined(values.words) + ")");
      for (const std::string& name : names_of(*option))
        script << " \\\n      " << in_quotes("*" + name + "[") << in_quotes(option->get_description(), "[]\\:") << in_quotes("]" + value);
    }
    script << " \\\n      '*:scene:_hooke_scenes' ;;\n";
  }
  script << "    *) _files ;;\n  esac\n}\n_hooke \"$@\"\n";
  return script.str();
}

std::string fish_completion() {
  CLI::App app;
  const DeclaredCommands commands = declare_command_line(app);
  std::ostringstream script;
  Words names;
  for (const auto& [command, work] : commands) names.push_back(command->get_name());
  const auto line = [&](const std::string& rest) {
    for (const char* program : {"hooke", "hooke-headless"}) script << "complete -c " << program << " " << rest << "\n";
  };
  for (const auto& [command, work] : commands) {
    line("-n __fish_use_subcommand -a " + command->get_name() + " -d " + in_quotes(command->get_description()));
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_positional()) continue;
      std::string rest = "-n " + in_quotes("__fish_seen_subcommand_from " + command->get_name());
      for (const std::string& name : option->get_snames()) rest += " -s " + name;
      for (const std::string& name : option->get_lnames()) rest += " -l " + name;
      const Values values = values_of(*option);
      if (takes_value(*option))
        rest += values.are_files ? " -r" : " -x" + (values.words.empty() ? "" : " -a " + in_quotes(joined(values.words)));
      line(rest + " -d " + in_quotes(option->get_description()));
    }
  }
  line("-a " + in_quotes(joined(scenes())));
  return script.str();
}

}  // namespace hooke
