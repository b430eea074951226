// hooke-headless bench --scaling
#pragma once

#include <filesystem>

namespace hooke {

// Prints a table and writes scaling.csv into the folder. Sizes up to 1e5 springs if `quick`. Returns the exit code.
int bench_scaling(const std::filesystem::path& folder, bool quick, bool quiet);

}  // namespace hooke
