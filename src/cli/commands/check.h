// hooke-headless check: the scenes' own checks, and the hard cases.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_check(CLI::App& app);

}  // namespace hooke
