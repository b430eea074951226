// The laws of springs in files, panels and pages.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "scene/parameters.h"

namespace hooke {

// What a new spring can be: the forces, in the order of SpringForce, and what moves.
inline constexpr std::array new_springs{
    ParameterChoice{"linear", "Linear", "Pulls when longer and pushes when shorter than its rest length."},
    ParameterChoice{"cable", "Cable", "Pulls when longer than its rest length, and is slack when shorter."},
    ParameterChoice{"strut", "Strut", "Pushes when shorter than its rest length, and does nothing when longer."},
    ParameterChoice{"cubic", "Cubic",
                    "The force is k e + k3 e^3, e the elongation: harder (k3 > 0) or softer (k3 < 0) than a linear spring."},
    ParameterChoice{"muscle", "Muscle", "Its rest length oscillates, by a fifth and once a second unless it is changed."},
    ParameterChoice{"winch", "Winch", "Its rest length falls, by a tenth per second to a fifth unless it is changed."},
};
inline constexpr auto spring_forces = std::span(new_springs).first<4>();

// The law of a new spring, a number of the above; the force of a cubic one is doubled at a strain of 1.
std::optional<SpringLaw> new_spring_law(int choice, double stiffness, double rest_length);

// What is wrong with the law of a spring: the field of the scene file and its limit; empty: nothing.
struct LawError {
  std::string_view field;
  std::string limit;
};
LawError error_of(const Spring& spring);

}  // namespace hooke
