// hooke bench --overhead
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/methods/integrator.h"

namespace hooke {

// What measuring the accuracy costs with these methods on these scenes, or the default ones if there are none: a table on stdout, and
// overhead.csv in the folder. Returns the exit code.
int bench_overhead(const std::filesystem::path& folder, const std::vector<std::string>& scenes,
                   const std::vector<const Integrator*>& methods, bool quick, bool quiet);

}  // namespace hooke
