// The benchmark chart: one panel per problem, error against cost on logarithmic axes, one line per method, and the
// Pareto front.
#pragma once

#include "study/gnuplot.h"
#include "study/work_precision_file.h"

namespace hooke {

GnuplotChart work_precision_chart(const Results& results);

}  // namespace hooke
