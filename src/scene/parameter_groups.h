// The groups of the table of parameters, which are the headings of the panel.
#pragma once

#include <string_view>

namespace hooke::parameter_group {

inline constexpr std::string_view simulation = "Simulation", springs = "Springs", points = "Points", surroundings = "Surroundings",
                                  contact = "Contact", new_parts = "New parts", hand = "Hand";

}  // namespace hooke::parameter_group
