#include "scene/shapes/fabric.h"

namespace hooke {

Fabric fabric_of(const Shape& shape) {
  Fabric fabric{.mass_model = static_cast<MassModel>(shape.count("mass_model")),
                .density = shape.find("density"),
                .mass = shape.find("mass"),
                .stiffness = shape.value_or("stiffness", 0.0),
                .stiffness_per_strain = shape.find("stiffness_per_strain"),
                .damping = shape.value_or("damping", 0.0),
                .damping_per_length = shape.find("damping_per_length"),
                .point_radius = shape.find("point_radius"),
                .nails = shape.nails};
  if (!fabric.density && !fabric.mass) fabric.mass = 1.0;
  return fabric;
}

std::optional<ShapeError> check_fabric(const Shape& shape, bool needs_stiffness) {
  if (shape.has("density") && shape.has("mass")) return ShapeError{{}, "must have density or mass, not both"};
  if (shape.has("stiffness") && shape.has("stiffness_per_strain"))
    return ShapeError{{}, "must have stiffness or stiffness_per_strain, not both"};
  if (shape.has("damping") && shape.has("damping_per_length")) return ShapeError{{}, "must have damping or damping_per_length, not both"};
  if (needs_stiffness && !shape.has("stiffness") && !shape.has("stiffness_per_strain"))
    return ShapeError{"stiffness", "must be a number of at least 0"};
  return std::nullopt;
}

}  // namespace hooke
