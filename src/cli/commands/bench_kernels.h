// hooke-headless bench --kernels: the limits of the machine, and how close stepping comes to them.
#pragma once

#include <filesystem>

namespace hooke {

// Prints two tables and writes kernels.csv into the folder. Two sizes instead of six if `quick`. Returns the exit code.
int bench_kernels(const std::filesystem::path& folder, bool quick, bool quiet);

}  // namespace hooke
