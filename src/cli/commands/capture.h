// hooke-headless capture: pictures of a scene as it moves, drawn with no display.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

std::function<int()> declare_capture(CLI::App& app);

}  // namespace hooke
