// Forecasts of the scene on the screen, made beside the run: the window never waits for one.
#pragma once

#include <future>

#include "lab/forecast.h"
#include "lab/status.h"

namespace hooke {

class Forecasting {
 public:
  ~Forecasting() { stop_ = true; }

  // Once a frame: takes what is ready, and begins anew where the scene was edited since.
  void follow(const Status& status);
  // Another document: what was foretold was of something else.
  void forget();
  const Forecast& newest() const { return newest_; }

 private:
  Forecast newest_;
  // What the newest, or the one in the making, is of. The name and the counts tell a document whose status comes late.
  struct Of {
    long edits = -1;
    std::string scene;
    Index points = 0, springs = 0;
    bool operator==(const Of&) const = default;
  };
  Of of_;
  bool is_of_other_ = false;  // the one in the making is of another document
  std::atomic<bool> stop_ = false;
  std::future<Forecast> making_;  // last: it is waited for before anything that it uses is gone
};

}  // namespace hooke
