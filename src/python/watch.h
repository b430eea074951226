// Long calls: they release the interpreter lock, show progress, and stop on Ctrl+C.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>

#include "lab/lab.h"

namespace hooke::python {

namespace py = pybind11;

// Created while the lock is held; checks for signals ten times a second.
class Watch {
 public:
  // `progress` is None, or is called with (done, all).
  explicit Watch(py::object progress) : progress_(std::move(progress)) {}

  // Called without the lock. Throws what a signal handler or `progress` raises, such as KeyboardInterrupt.
  void check() { check(done_, all_); }
  void check(long done, long all) {
    done_ = done;
    all_ = all;
    const auto now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(100) && done != all) return;
    last_ = now;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress_.is_none()) progress_(done, all);
  }

 private:
  using Clock = std::chrono::steady_clock;
  py::object progress_;
  long done_ = 0, all_ = -1;  // -1: not known
  Clock::time_point last_ = Clock::now();
};

// Checks after every substep of a laboratory, for as long as this object exists: a frame may take longer than a user waits.
class WatchedLab {
 public:
  WatchedLab(Lab& lab, Watch& watch) : lab_(lab) {
    lab_.watch_substeps([&watch] { watch.check(); });
  }
  ~WatchedLab() { lab_.watch_substeps({}); }
  WatchedLab(const WatchedLab&) = delete;
  WatchedLab& operator=(const WatchedLab&) = delete;

 private:
  Lab& lab_;
};

}  // namespace hooke::python
