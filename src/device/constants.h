// The numbers of this module.
#pragma once

#include <cstddef>

#include "base/types.h"

namespace hooke {

inline constexpr Index device_group = 64;                // threads in a group: shaders/compute/common.glsl
inline constexpr Index device_sums = 1024;               // threads that sum the works of the points
inline constexpr std::size_t max_device_colliders = 16;  // each point keeps what it may touch in registers
// The groups that every OpenGL 4.3 can start at once.
inline constexpr Index max_device_points = 65535 * device_group;

}  // namespace hooke
