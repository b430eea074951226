// hooke-headless check: the checks of scenes, and the hard cases.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_check(CLI::App& app);

}  // namespace hooke
