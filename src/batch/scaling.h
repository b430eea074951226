// Time and memory of scenes from 1e3 to 4e6 springs: `hooke bench --scaling`.
#pragma once

#include <span>
#include <vector>

namespace hooke {

// A cloth of n x n points run with velocity_verlet, in a process of its own.
struct ScalingRow {
  int n = 0;
  long springs = 0;
  double step_ms = 0.0;     // CPU time of a step, the minimum of several frames
  double peak_bytes = 0.0;  // peak resident memory, without that of a process that does nothing
  double ns_per_spring() const { return step_ms * 1e6 / static_cast<double>(springs); }
  double bytes_per_spring() const { return peak_bytes / static_cast<double>(springs); }
};

// Points along a side of the cloths, for quick measurements only those of less than 1e5 springs.
std::span<const int> scaling_sizes(bool quick);

// Throws FileError if a process cannot be started or fails.
ScalingRow measure_scaling(int n);

// The slope of log(time of a step) over log(springs), by least squares; 1: proportional.
double scaling_slope(const std::vector<ScalingRow>& rows);

}  // namespace hooke
