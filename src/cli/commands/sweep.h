// hooke-headless sweep: runs a scene with every combination of parameter values and tabulates what is measured.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_sweep(CLI::App& app);

}  // namespace hooke
