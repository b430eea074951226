// The benchmark chart, as a gnuplot script: one panel per problem, error against cost on logarithmic axes, one line per method, and the
// Pareto front.
#pragma once

#include <string>

#include "study/work_precision_file.h"

namespace hooke {

enum class ChartFormat { Svg, Png };

// Draws to the standard output of gnuplot.
std::string chart_script(const Results& results, ChartFormat format);

}  // namespace hooke
