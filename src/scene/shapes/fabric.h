// The properties that cloths and ropes have in common, and their fields in a file.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/shape.h"

namespace hooke {

// How the masses and stiffnesses of single points and springs follow from the given values.
enum class MassModel {
  Equal,      // a plain spring graph: every point has the same mass, every spring exactly the k and d given
  Tributary,  // a material: each point has the mass of its surroundings; k and d do not depend on the number of points
};

struct Fabric {
  MassModel mass_model = MassModel::Equal;
  // exactly one of the two: mass per area [kg/m^2] or length [kg/m], or total mass [kg]
  std::optional<double> density, mass;
  double stiffness = 0.0;                      // [N/m]
  std::optional<double> stiffness_per_strain;  // Y [N] instead: k = Y / rest length of each spring
  double damping = 0.0;                        // [N s/m]
  std::optional<double> damping_per_length;    // c [N s/m^2] instead: d = c rest length of each spring
  std::optional<double> point_radius;          // [m]; none: a quarter of the spacing
  std::vector<Index> nails;                    // indices within the shape
};

inline constexpr std::string_view mass_models[] = {"equal", "tributary"};
inline constexpr std::size_t fabric_numbers = 8;

// The parameters that cloths and ropes have in common.
constexpr std::array<ShapeNumber, fabric_numbers> make_fabric_numbers(MassModel default_model) {
  return {{
      {.name = "mass_model", .min = 0, .max = 1, .default_value = static_cast<double>(default_model), .choices = mass_models},
      {.name = "density", .unit = "kg/m^2, kg/m", .min = 0.01, .max = 10, .default_value = not_given},
      {.name = "mass", .unit = "kg", .min = 0.001, .max = 100, .default_value = not_given},
      {.name = "stiffness", .unit = "N/m", .min = 0, .max = 1e5, .default_value = not_given},
      {.name = "stiffness_per_strain", .unit = "N", .min = 0, .max = 1e5, .default_value = not_given},
      {.name = "damping", .unit = "N s/m", .min = 0, .max = 10, .default_value = not_given},
      {.name = "damping_per_length", .unit = "N s/m^2", .min = 0, .max = 10, .default_value = not_given},
      {.name = "point_radius", .unit = "m", .min = 0, .max = 1, .default_value = not_given},
  }};
}

Fabric fabric_of(const Shape& shape);

// Values that contradict each other or are missing. `needs_stiffness`: unless the shape specifies it otherwise.
std::optional<ShapeError> check_fabric(const Shape& shape, bool needs_stiffness = true);

}  // namespace hooke
