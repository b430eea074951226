// Reports of benchmark results.
#pragma once

#include <string>

#include "study/work_precision_file.h"

namespace hooke {

// For a terminal: the reference, and the cheapest method for each decade of error from 1e-1 to 1e-10; decades with the same method and
// setting share a line.
std::string report(const ProblemRecord& record);

// The same for all problems as Markdown tables, with the conditions of the measurement.
std::string markdown_report(const Results& results);

}  // namespace hooke
