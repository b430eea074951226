// The charts of a sweep, as scripts for gnuplot, which draws to its standard output.
#pragma once

#include <string>

#include "batch/sweep/sweep_journal.h"
#include "study/work_precision_chart.h"

namespace hooke {

// One panel for each measure: lines over the parameter with the most values, one for each combination of the others; with two parameters of
// many values a heat map. Empty if no chart can show the sweep: more than two parameters with too many combinations for lines.
std::string sweep_chart_script(const Sweep& sweep, const SweepRows& rows, ChartFormat format);

}  // namespace hooke
