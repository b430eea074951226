// The laws of springs in files, panels and pages.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "sim/model/spring_list.h"

namespace hooke {

struct SpringForceRow {
  std::string_view id;           // in files
  std::string_view label;        // in panels
  std::string_view description;  // one sentence
};
// In the order of SpringForce.
inline constexpr std::array spring_forces{
    SpringForceRow{"linear", "Linear", "Pulls when longer and pushes when shorter than its rest length."},
    SpringForceRow{"cable", "Cable", "Pulls when longer than its rest length, and is slack when shorter."},
    SpringForceRow{"strut", "Strut", "Pushes when shorter than its rest length, and does nothing when longer."},
    SpringForceRow{"cubic", "Cubic",
                   "The force is k e + k3 e^3, e the elongation: harder (k3 > 0) or softer (k3 < 0) than a linear spring."},
};

// What is wrong with the law of a spring: the field of the scene file and its limit; empty: nothing.
struct LawError {
  std::string_view field;
  std::string limit;
};
LawError error_of(const Spring& spring);

}  // namespace hooke
