// Benchmark results against earlier ones: whether a method has become less accurate. Times are not compared, they depend on the machine.
#pragma once

#include <vector>

#include "batch/junit.h"
#include "study/work_precision_file.h"

namespace hooke {

// One case for each problem, method and setting of both results. It failed if its error is more than 10 % larger, beyond the uncertainty of
// the reference, or if the run did not finish although the earlier one did.
std::vector<JunitCase> compare_with_earlier(const Results& earlier, const Results& now);

}  // namespace hooke
