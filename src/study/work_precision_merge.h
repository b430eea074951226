// Benchmark results of several processes in one table.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/work_precision_file.h"

namespace hooke {

struct MergedResults {
  Results results;
  std::string missing;  // the parts that are missing or not finished, in one clause; empty: none
};

// The results with the names of their files. Of a row that several of them have, the first counts. Throws InputError if they were measured
// under different conditions or if a problem differs.
MergedResults merge_results(const std::vector<std::pair<std::string, Results>>& parts);

}  // namespace hooke
