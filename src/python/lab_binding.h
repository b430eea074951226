// The laboratory as Python holds it.
#pragma once

#include <memory>
#include <string>

#include "lab/lab.h"
#include "python/scene_binding.h"

namespace hooke::python {

struct NamedLab {
  std::string name;
  std::shared_ptr<Lab> lab;
};

// {"kinetic", ..., "total"} [J].
py::dict energy_of(const Lab& lab);
// {"frame", "frame_max", "accumulated" [m], "amplification" [1], "predictable" [s]}; None: not known.
py::dict error_of(const Accuracy& accuracy);

}  // namespace hooke::python
