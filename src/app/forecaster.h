// Forecasts of the scene on the screen, made beside the run: the window never waits for one.
#pragma once

#include <future>

#include "lab/status.h"
#include "study/forecast.h"

namespace hooke {

class Forecaster {
 public:
  ~Forecaster() { stop_ = true; }

  // Once a frame: takes what is ready, and begins anew where the scene was edited since.
  void follow(const Status& status);
  // Another document: what was foretold was of something else.
  void forget();
  const Forecast& newest() const { return last_in_cell_; }

 private:
  Forecast last_in_cell_;
  // What the newest, or the one in the making, is of. The name and the counts tell a document whose status comes late.
  struct ForecastKey {
    long edits = -1;
    std::string scene;
    Index points = 0, springs = 0;
    bool operator==(const ForecastKey&) const = default;
  };
  ForecastKey key_;
  bool is_stale_ = false;  // the one in the making is of another document
  std::atomic<bool> stop_ = false;
  std::future<Forecast> pending_;  // last: it is waited for before anything that it uses is gone
};

}  // namespace hooke
