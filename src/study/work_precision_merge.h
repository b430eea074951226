// Benchmark results of several processes in one table.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/work_precision_file.h"

namespace hooke {

// The results with the names of their files. Of a row that several of them have, the first counts. Throws InputError if they were measured
// under different conditions or if a problem differs.
Results merge_results(const std::vector<std::pair<std::string, Results>>& parts);

}  // namespace hooke
