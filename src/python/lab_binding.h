// The laboratory as Python holds it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lab/lab.h"
#include "python/scene_binding.h"
#include "python/turn.h"

namespace hooke::python {

// A Use or a Change guards every access.
struct NamedLab {
  NamedLab(const NamedScene& scene, KeepStart keep) : name(scene.name), functions(scene.functions), lab(scene.scene(), keep) {}

  std::string name;
  std::vector<ForceFunction> functions;
  Lab lab;
  std::string accuracy = "off";  // what is measured
  std::int64_t threads = 1;
  std::string precision = "double", device = "cpu";
  bool is_in_run = false;            // `run` computes its frames
  py::object positions, velocities;  // read-only arrays of the present state; null until they are read
  Shared shared;
};

// One thread uses a laboratory at a time. Throws UsageError if a force that is a Python function uses the laboratory that calls it.
class Use {
 public:
  explicit Use(NamedLab& lab) : turn_(lab.shared, "lab: is computing a frame: a force cannot use it") {}

 private:
  Turn turn_;
};

// A use after which the state differs.
class Change : public Use {
 public:
  explicit Change(NamedLab& lab) : Use(lab), lab_(lab) {}
  ~Change() { lab_.positions = lab_.velocities = py::object(); }
  Change(const Change&) = delete;
  Change& operator=(const Change&) = delete;

 private:
  NamedLab& lab_;
};

// "off", "frame", "full". Throws UsageError.
AccuracyMode accuracy_named(const std::string& name);

}  // namespace hooke::python
