// The frequencies of what is plotted.
#pragma once

#include <optional>
#include <vector>

#include "lab/traces.h"

namespace hooke {

// The amplitude at each frequency [Hz], which takes the place of the time, of the values between two times [s]: their discrete Fourier
// transform with a Hann window. Only up to the highest frequency that is noticed. Empty where there are too few values.
TraceTable spectrum_of(const TraceTable& table, double first, double last);

// [Hz], of the highest peak of these traces. None where no peak has two periods within the values: slower changes cannot be told from a
// drift of the mean.
std::optional<double> peak_of(const TraceTable& spectrum, const std::vector<const Trace*>& traces);

}  // namespace hooke
