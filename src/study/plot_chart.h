// The plots of the window as a chart.
#pragma once

#include "lab/traces.h"
#include "study/gnuplot.h"

namespace hooke {

// A panel for each unit, of what is between two times [s], or up to a frequency [Hz].
GnuplotChart plot_chart(const TraceTable& table, double first, double last, bool is_spectrum);

}  // namespace hooke
