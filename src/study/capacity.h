// How large a scene each method can run in real time at a given error: `hooke bench --capacity`.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/reference.h"

namespace hooke {

// Of the picture: the time that one frame may take is its inverse.
inline constexpr double capacity_frame_rate = 60.0;  // [1/s]

// A cloth of n x n points, 1 m wide, that one method steps within the time of a frame and within the error.
struct Capacity {
  int n = 0;
  long springs = 0;
  Setting setting;              // cheapest found; its steps are those of four frames
  double relative_error = 0.0;  // [1], of the positions (RMS), relative to the width: the worst of the times compared
  double frame_seconds = 0.0;   // CPU time of a frame on one core, the minimum of several runs
  int substeps() const;         // per frame
};

struct CapacityRow {
  const Integrator* method = nullptr;
  std::optional<Capacity> largest;  // none: not even the smallest cloth
  bool is_bounded = true;           // false: the largest cloth tried, or the last one with a reference, is within the time and the error
};

struct CapacityResult {
  std::vector<CapacityRow> rows;
  int largest_n = 0;   // of the last cloth with a reference
  std::string reason;  // why there is none for the next; empty: all sizes were measured
};

// Points along a side of the cloths, ascending; for quick measurements only small ones.
std::span<const int> capacity_sizes(bool quick);

// Measures the methods on cloths of increasing size, each until it is too slow for `relative_error` [1]. The cloth hangs from two corners
// and is released horizontally; 16 frames are compared with a reference, for which two methods take up to `reference_seconds` each.
// `begin_size` is called with each size; `should_continue` often, and false ends with the rows so far.
CapacityResult measure_capacity(std::span<const Integrator* const> methods, std::span<const int> sizes, double relative_error,
                                double reference_seconds, const std::function<void(int n)>& begin_size,
                                const std::function<bool()>& should_continue);

}  // namespace hooke
