// The numbers of this module that change results or the order of sums.
#pragma once

#include "base/types.h"

namespace hooke {

// The number of springs from which a scene is stepped in grids. In smaller scenes there is little time to save.
inline constexpr Index min_springs_of_grids = 256;
// [points], of a row of a grid: shorter ones leave most lanes of a vector of eight empty. And of a grid of a single row.
inline constexpr Index min_grid_columns = 4, min_grid_rope = 8;
// The number of widths that are tried for grids, the most frequent ones: it bounds the time that a graph without grids takes.
inline constexpr std::size_t max_grid_widths = 16;
// [springs], of a run: longer ones are split, so that what a kernel reads of one stays in a fast cache.
inline constexpr Index max_run_length = 512;

// Faces below this height, relative to their longest side [1], are degenerate; and those whose area is not between these [m^2], at which
// stiffnesses overflow.
inline constexpr double min_relative_height = 1e-6, min_rest_area = 1e-200, max_rest_area = 1e200;

// The thickness of a face or spring is at most this part of its smallest height or length at rest [1], so that it does not touch its
// neighbors at rest.
inline constexpr double max_relative_thickness = 0.5;
// The same for the minimum, which keeps the thickness from vanishing.
inline constexpr double min_relative_thickness = 0.05;
// [m], of faces without springs.
inline constexpr double min_thickness = 1e-3;

// [1], the mass of a roller along a fixed axis in matrices, relative to its own: so large that what it moves is lost in rounding.
inline constexpr double fixed_mass_ratio = 1e60;

// [1], by which a run may exceed the estimate of how far its points get before it counts as unstable.
inline constexpr double reach_margin = 1000.0;

}  // namespace hooke
