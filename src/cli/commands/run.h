// hooke-headless run: simulates a scene and reports the result.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_run(CLI::App& app);

}  // namespace hooke
