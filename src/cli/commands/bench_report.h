// The benchmark's results in words.
#pragma once

#include <string>

#include "study/work_precision_file.h"

namespace hooke {

// For a terminal: the reference and the cheapest method for each decade of error from 1e-1 to 1e-10; decades with the
// same answer share a line.
std::string report(const ProblemRecord& record);

// The same for all problems as tables in Markdown, with the conditions of the measurement.
std::string markdown_report(const Results& results);

}  // namespace hooke
