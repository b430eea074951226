// The laboratory as Python holds it.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "lab/lab.h"
#include "python/scene_binding.h"

namespace hooke::python {

// A Use or a Change guards every access.
struct NamedLab {
  NamedLab(const NamedScene& scene, KeepStart keep) : name(scene.name), functions(scene.functions), lab(scene.scene(), keep) {}

  std::string name;
  std::vector<ForceFunction> functions;
  Lab lab;
  bool is_in_run = false;             // `run` computes its frames
  py::object positions, velocities;   // read-only arrays of the present state; null until they are read
  std::timed_mutex mutex;             // locked while a thread uses it
  std::atomic<std::thread::id> user;  // that thread
};

// One thread uses a laboratory at a time. Waits for another one, without the interpreter lock, until Ctrl+C. Throws UsageError if this
// thread uses it already: a force that is a Python function calls back.
class Use {
 public:
  explicit Use(NamedLab& lab);
  ~Use();
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;

 private:
  NamedLab& lab_;
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
