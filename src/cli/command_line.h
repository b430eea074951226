// The declaration of the command line of hooke-headless, which main executes and the manual and the completion are generated from.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "cli/subcommand.h"

namespace hooke {

// Each subcommand with the function that runs it, in help order.
using DeclaredCommands = std::vector<std::pair<CLI::App*, std::function<int()>>>;

// Declares all subcommands and their options.
DeclaredCommands declare_command_line(CLI::App& app);

}  // namespace hooke
