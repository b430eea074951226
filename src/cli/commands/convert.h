// hooke-headless convert: reads a file in one format and writes it in another.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_convert(CLI::App& app);

}  // namespace hooke
