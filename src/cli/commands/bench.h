// hooke-headless bench: speed against error of every method, on the built-in problems or on given scenes.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_bench(CLI::App& app);

}  // namespace hooke
