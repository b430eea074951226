// A scene as Python holds it, and the functions that bind the classes of the module.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "batch/scene_options.h"
#include "python/arrays.h"
#include "python/watch.h"

namespace hooke::python {

// A scene with the name it was loaded by, for messages, and the warnings about its file.
struct NamedScene {
  std::string name;
  LoadedScene loaded;
  Scene& scene() { return loaded.scene; }
  const Scene& scene() const { return loaded.scene; }
};

// integrator, substeps, frame_rate, tolerance, settings: as the options of the command line.
SteppingOptions options_from(const py::dict& options);

// A copy of the scene with the options applied.
NamedScene with_options(const NamedScene& scene, const py::dict& options);

void bind_scene(py::module_& module);
void bind_lab(py::module_& module);
void bind_run(py::module_& module);
void bind_study(py::module_& module);
void bind_capture(py::module_& module);
void bind_tables(py::module_& module);

}  // namespace hooke::python
