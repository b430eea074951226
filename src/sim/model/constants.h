// The numbers of this module that change results.
#pragma once

namespace hooke {

// Steps in a period of a collider or muscle that oscillates: the parabolas of contact (contact/obstacle.h) then deviate by 5e-4 of the
// amplitude and 2 % of the largest velocity.
inline constexpr double steps_per_period = 16.0;

}  // namespace hooke
