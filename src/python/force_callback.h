// Forces that are computed by a Python function: a force term outside of the table of forces.
#pragma once

#include <pybind11/pybind11.h>

#include "scene/scene.h"

namespace hooke::python {

namespace py = pybind11;

// Adds a force that calls function(time, positions, velocities) at every evaluation of the forces, and once more for the energy balance. It
// receives two arrays of shape (points, 3) in [m] and [m/s], and returns the forces [N] in the same shape. The function is kept until the
// program ends. Throws InputError if the scene already has too many forces.
void add_force_callback(Scene& scene, py::function function);

// Whether the scene has such a force, which cannot be written to a file.
bool has_force_callback(const Scene& scene);

}  // namespace hooke::python
