// hooke-headless run: steps a scene and reports what became of it.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_run(CLI::App& app);

}  // namespace hooke
