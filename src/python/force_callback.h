// Forces that are computed by a Python function: a force term outside of the table of forces.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "scene/scene.h"

namespace hooke::python {

namespace py = pybind11;

// Keeps a Python function that forces call. It is released with the last copy.
using ForceFunction = std::shared_ptr<const void>;

// Adds a force that calls function(time, positions, velocities) at every evaluation of the forces, and once more for the energy balance. It
// receives two arrays of shape (points, 3) in [m] and [m/s], and returns the forces [N] in the same shape. Who steps the scene must keep
// the function. Throws InputError if the scene already has too many forces.
[[nodiscard]] ForceFunction add_force_callback(Scene& scene, py::function function);

// Whether the scene has such a force, which cannot be written to a file.
bool has_force_callback(const Scene& scene);

}  // namespace hooke::python
