// hooke-headless bench --edits
#pragma once

#include <filesystem>

namespace hooke {

// Prints a table and writes edits.csv into the folder. Cloths of 32 x 32 points if `quick`. Returns the exit code.
int bench_edits(const std::filesystem::path& folder, bool quick, bool quiet);

}  // namespace hooke
