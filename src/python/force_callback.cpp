#include "python/force_callback.h"

#include <algorithm>
#include <map>

#include "base/errors.h"
#include "base/file_limits.h"
#include "edit/command.h"
#include "python/arrays.h"
#include "sim/plan/plan.h"

namespace hooke::python {
namespace {

// The functions in use, by the first value of their force. Never destroyed, because the interpreter ends first.
std::map<double, py::function>& functions() {
  static auto* const all = new std::map<double, py::function>;
  return *all;
}

// From the layout of the Plan to (points, 3), in the order of the scene.
py::array_t<double> packed_to_array(const Plan& plan, const double* field) {
  py::array_t<double> array({static_cast<py::ssize_t>(plan.points), py::ssize_t{3}});
  double* at = array.mutable_data();
  for (Index i = 0; i < plan.points; ++i)
    for (int c = 0; c < 3; ++c) *at++ = c < plan.dimensions ? field[static_cast<std::size_t>(c) * plan.points + i] : 0.0;
  return array;
}

std::vector<Vec3> call(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v) {
  const py::gil_scoped_acquire lock;
  const py::object result = functions().at(values[0])(time, packed_to_array(plan, x), packed_to_array(plan, v));
  const auto forces = Doubles::ensure(result);
  if (!forces) throw InputError("forces: must be numbers");
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
ForceBound bound(const System&, const Plan&, const ForceValues&, double) {
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
    .power = power,
};

}  // namespace

ForceFunction add_force_callback(Scene& scene, py::function function) {
  const std::size_t count = scene.system.forces.size() + 1;
  if (count > max_forces) throw InputError("forces: " + std::to_string(count) + ": must be at most " + std::to_string(max_forces));
  const double key = functions().empty() ? 0.0 : functions().rbegin()->first + 1.0;
  functions().emplace(key, std::move(function));
  ForceFunction kept(nullptr, [key](const void*) {
    const py::gil_scoped_acquire lock;
    // destroyed last, because that may run Python code
    const auto released = functions().extract(key);
  });
  Force force{.term = &callback};
  force.values[0] = key;
  SetForces set{scene.system.forces};
  set.forces.push_back(force);
  Effect effect;
  apply(scene, set, effect);
  return kept;
}

bool has_force_callback(const Scene& scene) {
  return std::ranges::any_of(scene.system.forces, [](const Force& force) { return force.term == &callback; });
}

}  // namespace hooke::python
