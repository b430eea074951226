// hooke-headless bench --capacity
#pragma once

#include <filesystem>
#include <span>

#include "sim/methods/integrator.h"

namespace hooke {

// Prints a table and writes capacity.csv into the folder: the largest cloth that each method steps in real time with at most
// `relative_error` [1]. Cloths of up to 256 points if `quick`. Returns the exit code.
int bench_capacity(const std::filesystem::path& folder, std::span<const Integrator* const> methods, double relative_error, bool quick,
                   bool quiet);

}  // namespace hooke
