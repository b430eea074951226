// Constants of tests in which things fall.
#pragma once

namespace hooke {

inline constexpr double g = 9.81;                 // [m/s^2]
inline constexpr double frame_time = 1.0 / 60.0;  // [s]

}  // namespace hooke
