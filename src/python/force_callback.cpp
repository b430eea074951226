#include "python/force_callback.h"

#include "base/errors.h"
#include "base/file_limits.h"
#include "edit/apply.h"
#include "python/arrays.h"
#include "sim/plan.h"

namespace hooke::python {
namespace {

// The functions, referred to by the first value of a force. Never destroyed, because the interpreter ends first.
std::vector<py::function>& functions() {
  static auto* const all = new std::vector<py::function>;
  return *all;
}

// From the layout of the Plan to (points, 3).
py::array_t<double> packed_to_array(const Plan& plan, const double* field) {
  py::array_t<double> array({static_cast<py::ssize_t>(plan.points), py::ssize_t{3}});
  double* at = array.mutable_data();
  for (Index i = 0; i < plan.points; ++i)
    for (int c = 0; c < 3; ++c) *at++ = c < plan.dimensions ? field[static_cast<std::size_t>(c) * plan.points + i] : 0.0;
  return array;
}

std::vector<Vec3> call(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v) {
  const py::gil_scoped_acquire lock;
  const py::object result = functions()[static_cast<std::size_t>(values[0])](time, packed_to_array(plan, x), packed_to_array(plan, v));
  const auto forces = Doubles::ensure(result);
  if (!forces) throw py::error_already_set();
  return to_vectors("forces", forces, static_cast<std::size_t>(plan.points));
}

void add(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v, double* f) {
  const std::vector<Vec3> forces = call(plan, values, time, x, v);
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i) f[static_cast<std::size_t>(c) * plan.points + i] += forces[i][c];
}

double power(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v) {
  const std::vector<Vec3> forces = call(plan, values, time, x, v);
  double sum = 0.0;
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] != 0.0) sum += forces[i][c] * v[static_cast<std::size_t>(c) * plan.points + i];
  return sum;
}

// Nothing is known about the function.
ForceBound bound(const System&, const ForceValues&) {
  return {.stiffness = ForceBound::none, .rate = ForceBound::none, .acceleration = ForceBound::none, .speed = ForceBound::none};
}

constinit const ForceTerm callback{
    .id = "python",
    .label = "Python",
    .description = "A force that is computed by a Python function.",
    .numbers = {},
    .depends_on_velocity = true,
    .is_continuous = false,
    .add = add,
    .bound = bound,
    .add_tangent = nullptr,
    .potential = nullptr,
    .power = power,
};

}  // namespace

void add_force_callback(Scene& scene, py::function function) {
  if (scene.system.forces.size() >= max_forces) throw InputError("forces: must be at most " + std::to_string(max_forces));
  functions().push_back(std::move(function));
  Force force{.term = &callback};
  force.values[0] = static_cast<double>(functions().size() - 1);
  SetForces set{scene.system.forces};
  set.forces.push_back(force);
  Effect effect;
  apply(scene, set, effect);
}

bool has_force_callback(const Scene& scene) {
  return std::ranges::any_of(scene.system.forces, [](const Force& force) { return force.term == &callback; });
}

}  // namespace hooke::python
