// The laboratory on a separate thread: it receives commands through a queue and publishes a Status with a Snapshot. Callers never wait for
// a step. The states have the same bits as without the thread.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "edit/command.h"
#include "edit/history.h"
#include "lab/controls.h"
#include "lab/status.h"

namespace hooke {

class Lab;

// All functions may be called from any one thread, usually that of the window.
class LabThread {
 public:
  explicit LabThread(Scene scene);
  ~LabThread();  // waits for the substep in progress
  LabThread(const LabThread&) = delete;
  LabThread& operator=(const LabThread&) = delete;

  // `name`: of the step in the history; without one the command's own.
  void submit(Command command, Gesture gesture = 0, std::string name = {});
  void submit(Control control, Gesture gesture = 0);

  // The latest status; never null.
  std::shared_ptr<const Status> status() const;

  // A copy of the scene between two frames, after all earlier submissions: as it is now, or at its start, which is what a file contains.
  enum class Moment { Start, Present };
  std::future<std::shared_ptr<const Scene>> copy_scene(Moment moment);

  // Waits up to `max_wait` until the status reflects all earlier submissions; returns whether it does.
  bool settle(std::chrono::milliseconds max_wait);

  // Ids for the points and springs of an Insert.
  PointId new_point_id();
  SpringId new_spring_id();

 private:
  using Task = std::function<void(Lab&)>;
  void post(Task task, bool urgent);
  void work();

  std::unique_ptr<Lab> lab_;
  mutable std::mutex mutex_;
  std::condition_variable posted_;
  std::vector<Task> tasks_;               // guarded by mutex_
  std::shared_ptr<const Status> status_;  // guarded by mutex_
  std::condition_variable published_;
  long posted_count_ = 0, published_count_ = 0;  // tasks; guarded by mutex_
  std::atomic<bool> stopping_ = false;
  std::atomic<bool> urgent_ = false;                      // a submitted request interrupts the frame in progress
  std::uint32_t next_point_id_ = 0, next_spring_id_ = 0;  // of the calling thread
  std::thread thread_;
};

}  // namespace hooke
