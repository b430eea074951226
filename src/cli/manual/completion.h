// Completion of command lines in shells, generated from the tables that the programs use: commands, options with their values, and the
// ids of scenes, methods and parameters.
#pragma once

#include <string>

namespace hooke {

std::string bash_completion();
std::string zsh_completion();
std::string fish_completion();

}  // namespace hooke
