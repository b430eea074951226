// The numbers of this module that change results or the order of sums.
#pragma once

#include "base/types.h"

namespace hooke {

// From this number of springs on, a scene is stepped in grids. In smaller scenes there is little time to save.
inline constexpr Index min_springs_of_grids = 256;
// [points] Minimum length of a row of a grid, and of a grid of a single row. Shorter rows leave most lanes of a vector of eight empty.
inline constexpr Index min_grid_columns = 4, min_grid_rope = 8;
// The most frequent widths are tried for grids, at most this many. This bounds the time that a graph without grids takes.
inline constexpr std::size_t max_grid_widths = 16;
// [springs] Longer runs are split, so that what a kernel reads of a run stays in a fast cache.
inline constexpr Index max_run_length = 512;

// Faces below this height, relative to their longest side [1], are degenerate. So are faces whose area is not between these [m^2], where
// stiffnesses overflow.
inline constexpr double min_relative_height = 1e-6, min_rest_area = 1e-200, max_rest_area = 1e200;

// The thickness of a face or spring is at most this part of its smallest height or length at rest [1], so that it does not touch its
// neighbors at rest.
inline constexpr double max_relative_thickness = 0.5;
// The thickness is at least this part of that height or length [1], so that it does not vanish.
inline constexpr double min_relative_thickness = 0.05;
// [m] Minimum thickness of faces without springs.
inline constexpr double min_thickness = 1e-3;

// [1] Mass of a roller along a fixed axis in matrices, relative to its own. It is so large that the motion is lost in rounding.
inline constexpr double fixed_mass_ratio = 1e60;

// [1] A run counts as unstable if its points get this many times as far as estimated.
inline constexpr double reach_margin = 1000.0;

}  // namespace hooke
