#pragma once

#include "ui/keys.h"

namespace hooke {

inline constexpr Modifiers control{.control = true}, control_shift{.control = true, .shift = true};

}  // namespace hooke
