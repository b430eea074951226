// hooke-headless convert: reads a file of one kind and writes it as another.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_convert(CLI::App& app);

}  // namespace hooke
