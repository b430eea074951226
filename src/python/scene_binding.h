// A scene as Python holds it, and the functions that bind the classes of the module.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "batch/scene_options.h"
#include "python/arrays.h"
#include "python/force_callback.h"
#include "python/watch.h"

namespace hooke::python {

// A scene with the name it was loaded by, for messages, the warnings about its file, and the Python functions that its forces call.
struct NamedScene {
  std::string name;
  LoadedScene loaded;
  std::vector<ForceFunction> functions{};
  std::vector<std::string> told{};  // the warnings that the function which loaded it gave
  // The options of the last run and its warnings, which take longer than a short run and are the same until the scene changes.
  struct Checked {
    SteppingOptions options;
    std::vector<std::string> warnings;
  };
  mutable std::optional<Checked> checked{};
  // to change it
  Scene& scene() {
    checked.reset();
    return loaded.scene;
  }
  const Scene& scene() const { return loaded.scene; }
};

// A parameter or a shape that there is not, as KeyError.
struct UnknownName : UsageError {
  using UsageError::UsageError;
};

// For the arguments threads, precision and device. Throws UsageError.
Execution execution_of(const Lab& lab, std::int64_t threads, const std::string& precision = "double", const std::string& device = "cpu");

// The parameter of scene["NAME"] with the owner "scene", and its new value. Throws UsageError 'scene["NAME"]: VALUE: must be ...'.
const Parameter& parameter_of(const char* owner, const std::string& name);
SetParameter setting_of(const char* owner, const std::string& name, const std::string& value);
py::object value_of(const Scene& scene, const Parameter& parameter);

// From the texts of the options by name. Throws UsageError.
ImportOptions to_import_options(const std::map<std::string, std::string>& texts);

// As to_vectors. Throws InputError if the scene is 2-D and a vector leaves its plane.
std::vector<Vec3> flat_vectors(const System& system, const std::string& name, const Doubles& array, std::size_t count);

void bind_scene(py::module_& module);
void bind_lab(py::module_& module);
void bind_run(py::module_& module);
void bind_study(py::module_& module);
void bind_sweep(py::module_& module);
void bind_capture(py::module_& module);
void bind_tables(py::module_& module);

}  // namespace hooke::python
