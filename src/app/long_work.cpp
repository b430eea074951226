#include "app/long_work.h"

namespace hooke {

LongWork::~LongWork() {
  stop();
  if (run_.valid()) run_.wait();
}

void LongWork::start(std::string what, Work work) {
  what_ = std::move(what);
  started_ = std::chrono::steady_clock::now();
  progress_ = std::make_shared<Progress>();
  run_ = std::async(std::launch::async, [work = std::move(work), progress = progress_] {
    return work([&](double share) {
      progress->share = share;
      return !progress->stop;
    });
  });
}

bool LongWork::follow(std::chrono::milliseconds at_most) {
  if (!run_.valid()) return true;
  if (run_.wait_for(at_most) != std::future_status::ready) return false;
  // what is left to do may start the next work
  const Finish finish = run_.get();
  finish();
  return !run_.valid();
}

double LongWork::seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(); }

}  // namespace hooke
