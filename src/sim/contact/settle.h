// Impulses between many points that touch at the same time.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/touch.h"

namespace hooke {

// Changes the velocities v, one per path, by the impulses of the touches: along the normal the minimum for which no touch is slower than
// its min_velocity, friction of up to its coefficient times that against the rest of the relative velocity. Impulses are equal and
// opposite, so that momentum is conserved, and so is angular momentum without friction. Starts from the impulses in `touches`, and leaves
// the result there. Projected Gauss-Seidel, forward and backward in turn, until no relative velocity changes by more than `tolerance`
// [m/s], at most max_settle_sweeps times. Returns the number of impulses computed.
long settle(std::span<Touch> touches, std::span<const std::size_t> active, std::span<const PointPath> paths, double tolerance,
            std::span<Vec3> v);
inline constexpr int max_settle_sweeps = 200;

}  // namespace hooke
