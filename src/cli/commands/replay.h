// hooke replay LOG [--verify] [--json FILE] [--csv FILE] ...
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_replay(CLI::App& app);

}  // namespace hooke
