// hooke replay LOG [--verify]
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_replay(CLI::App& app);

}  // namespace hooke
