#include "app/work/background_task.h"

namespace hooke {

BackgroundTask::~BackgroundTask() {
  stop();
  if (run_.valid()) run_.wait();
}

void BackgroundTask::start(std::string what, Work work) {
  what_ = std::move(what);
  started_ = std::chrono::steady_clock::now();
  progress_ = std::make_shared<Progress>();
  run_ = std::async(std::launch::async, [work = std::move(work), progress = progress_] {
    return work([&](double fraction) {
      progress->fraction = fraction;
      return !progress->stop;
    });
  });
}

bool BackgroundTask::follow(std::chrono::milliseconds max_wait) {
  if (!run_.valid()) return true;
  if (run_.wait_for(max_wait) != std::future_status::ready) return false;
  // the completion may start the next work
  const Completion finish = run_.get();
  finish();
  return !run_.valid();
}

double BackgroundTask::seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(); }

}  // namespace hooke
