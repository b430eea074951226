// NumPy arrays and the vectors of the simulation: (n, 3) float64, C-contiguous.
#pragma once

#include <pybind11/numpy.h>

#include <span>
#include <string>
#include <vector>

#include "base/types.h"

namespace hooke::python {

namespace py = pybind11;

// Accepts anything that NumPy converts to float64.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

static_assert(sizeof(Vec3) == 3 * sizeof(double));

// A copy with the shape (n, 3).
py::array_t<double> to_array(std::span<const Vec3> vectors);
// Refuses assignments to its items, which would change a copy and not what it was copied from.
py::array read_only(py::array array);
py::array_t<double> to_array(const std::vector<double>& values);

// Throws InputError "NAME: shape (2, 3): must be (N, 3)" or "NAME[i]: must be finite numbers" if the shape differs or a value is not
// finite.
std::vector<Vec3> to_vectors(const std::string& name, const Doubles& array, std::size_t count);
// "(2, 3)".
std::string shape_of(const py::array& array);
// One value for each of `count`; a single value counts for all.
std::vector<double> to_values(const std::string& name, const Doubles& array, std::size_t count);

}  // namespace hooke::python
