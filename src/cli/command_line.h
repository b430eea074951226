// The command line of hooke-headless as it is declared: what main obeys, and the manual and the completion are made from.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "cli/subcommand.h"

namespace hooke {

// Each subcommand with what does its work, in the order of the help.
using DeclaredCommands = std::vector<std::pair<CLI::App*, std::function<int()>>>;

// Declares all subcommands and their options.
DeclaredCommands declare_command_line(CLI::App& app);

}  // namespace hooke
