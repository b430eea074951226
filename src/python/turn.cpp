#include "python/turn.h"

#include <pybind11/pybind11.h>

#include <chrono>

#include "base/errors.h"

namespace hooke::python {

Turn::Turn(Shared& shared, const char* message) : shared_(shared) {
  if (shared.user == std::this_thread::get_id()) throw UsageError(message);
  for (bool is_locked = shared.mutex.try_lock(); !is_locked;) {
    {
      const pybind11::gil_scoped_release unlocked;
      is_locked = shared.mutex.try_lock_for(std::chrono::milliseconds(100));
    }
    if (is_locked || PyErr_CheckSignals() == 0) continue;
    throw pybind11::error_already_set();
  }
  shared.user = std::this_thread::get_id();
}

Turn::~Turn() {
  shared_.user = std::thread::id();
  shared_.mutex.unlock();
}

}  // namespace hooke::python
