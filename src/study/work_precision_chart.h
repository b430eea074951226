// The benchmark's chart, as a script for gnuplot: a panel a problem, error against cost on logarithmic axes, a line a
// method with its name at the end, the front marked.
#pragma once

#include <string>

#include "study/work_precision_file.h"

namespace hooke {

enum class ChartFormat { Svg, Png };

// Draws into `file`, which is named as gnuplot sees it from its working folder.
std::string chart_script(const Results& results, ChartFormat format, const std::string& file);

}  // namespace hooke
