// The man page and the bash completion, generated from the tables that the programs use.
#pragma once

#include <string>

namespace hooke {

// hooke(1) in roff: commands and options as they are declared, keys, parameters, methods, exit codes.
std::string manual_page();

// For bash-completion: commands, options, and the ids of scenes, methods and parameters.
std::string bash_completion();

}  // namespace hooke
