// The subcommands of hooke-headless: each declares its options, and returns the function that runs it and returns the exit code.
#pragma once

#include "cli/subcommand.h"

namespace hooke {

// Speed against error of every method, on the built-in problems or on given scenes.
std::function<int()> declare_bench(CLI::App& app);
// Pictures of a scene as it moves, drawn with no display.
std::function<int()> declare_capture(CLI::App& app);
// The checks of scenes, and the hard cases.
std::function<int()> declare_check(CLI::App& app);
// Reads a file in one format and writes it in another.
std::function<int()> declare_convert(CLI::App& app);
// Replays a recording, and compares every frame with it.
std::function<int()> declare_replay(CLI::App& app);
// Simulates a scene and reports the result.
std::function<int()> declare_run(CLI::App& app);
// Runs a scene with every combination of parameter values and tabulates what is measured.
std::function<int()> declare_sweep(CLI::App& app);

}  // namespace hooke
