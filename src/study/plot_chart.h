// The plots of the window as a chart for gnuplot.
#pragma once

#include <string>

#include "lab/traces.h"
#include "study/work_precision_chart.h"

namespace hooke {

// A panel for each unit, of what is between two times [s], or up to a frequency [Hz].
std::string plot_chart(const TraceTable& table, double first, double last, bool is_spectrum, ChartFormat format);

}  // namespace hooke
