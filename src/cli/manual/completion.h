// What completes command lines in shells, from the tables that the programs use: commands, options with their values, and the ids of
// scenes, methods and parameters. packaging/completion makes the scripts of it.
#pragma once

#include <string>

namespace hooke {

// Lines of words between tabs: "scenes" and "general" options; "command", name and description; "option", command, names, kind, words and
// description. Kinds: flag, value (any), files, words (one of them), list (some of them, with commas between).
std::string completion_table();

}  // namespace hooke
