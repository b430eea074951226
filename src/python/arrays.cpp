#include "python/arrays.h"

#include <cstring>

#include "base/errors.h"
#include "base/finite.h"

namespace hooke::python {
namespace {

[[noreturn]] void refuse_shape(const std::string& name, const py::array& array, const std::string& wanted) {
  throw InputError(name + ": shape " + shape_of(array) + ": must be " + wanted);
}

}  // namespace

std::string shape_of(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t d = 0; d < array.ndim(); ++d) text += (d > 0 ? ", " : "") + std::to_string(array.shape(d));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

py::array_t<double> to_array(std::span<const Vec3> vectors) {
  py::array_t<double> array({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}});
  if (!vectors.empty()) std::memcpy(array.mutable_data(), vectors.data(), vectors.size_bytes());
  return array;
}

py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array_t<double> to_array(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

std::vector<Vec3> to_vectors(const std::string& name, const Doubles& array, std::size_t count) {
  if (array.ndim() != 2 || array.shape(1) != 3 || static_cast<std::size_t>(array.shape(0)) != count)
    refuse_shape(name, array, "(" + std::to_string(count) + ", 3)");
  std::vector<Vec3> vectors(count);
  if (count > 0) std::memcpy(vectors.data(), array.data(), count * sizeof(Vec3));
  for (std::size_t i = 0; i < count; ++i)
    if (!is_finite(vectors[i])) throw InputError(name + "[" + std::to_string(i) + "]: must be finite numbers");
  return vectors;
}

std::vector<double> to_values(const std::string& name, const Doubles& array, std::size_t count) {
  if (array.ndim() == 0) return std::vector<double>(count, *array.data());
  if (array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != count)
    refuse_shape(name, array, "one number or (" + std::to_string(count) + ",)");
  return std::vector<double>(array.data(), array.data() + count);
}

}  // namespace hooke::python
