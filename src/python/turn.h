// Threads of Python that take turns.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>

namespace hooke::python {

// What one thread uses at a time.
struct Shared {
  std::timed_mutex mutex;             // locked while a thread uses it
  std::atomic<std::thread::id> user;  // that thread
};

// The use of it by this thread. Created with the interpreter lock: waits for another thread without it, until Ctrl+C. Throws UsageError
// with the message if this thread uses it already: something that it calls calls back.
class Turn {
 public:
  Turn(Shared& shared, const char* message);
  ~Turn();
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  Shared& shared_;
};

}  // namespace hooke::python
