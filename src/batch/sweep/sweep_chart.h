// The chart of a sweep.
#pragma once

#include <optional>

#include "batch/sweep/sweep_journal.h"
#include "study/gnuplot.h"

namespace hooke {

// One panel for each measure: lines over the parameter with the most values, one for each combination of the others; with two parameters of
// many values a heat map. None if no chart can show the sweep: more than two parameters with too many combinations for lines.
std::optional<GnuplotChart> sweep_chart(const Sweep& sweep, const SweepRows& rows);

}  // namespace hooke
