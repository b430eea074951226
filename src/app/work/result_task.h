// Computes one result in a background thread: the window never waits for it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "app/work/background_task.h"
#include "ui/panels.h"

namespace hooke {

template <class Result>
class ResultTask {
 public:
  // Does nothing while one is running. `what`: "Comparing methods". `compute` must not throw, and ends early if its progress returns false.
  void start(std::string what, std::function<Result(const Progress&)> compute) {
    if (task_.is_running()) return;
    newest_.reset();
    task_.start(std::move(what), [this, compute = std::move(compute)](const Progress& progress) -> BackgroundTask::Completion {
      auto result = std::make_shared<const Result>(compute(progress));
      return [this, result] { newest_ = result; };
    });
  }
  void stop() {
    if (task_.is_running()) task_.stop();
  }
  // Once per frame: takes the result.
  void follow() { task_.follow(); }
  bool is_running() const { return task_.is_running(); }
  // For the panel.
  ResultStatus<Result> status() const {
    return {.is_running = task_.is_running(),
            .fraction = task_.is_running() ? task_.fraction() : 0.0,
            .seconds = task_.is_running() ? task_.seconds() : 0.0,
            .result = newest_};
  }

 private:
  std::shared_ptr<const Result> newest_;
  BackgroundTask task_;  // last: the destructor waits for it before anything that it uses is destroyed
};

}  // namespace hooke
