// Forecasts for the scene on screen, computed in a background thread: the window never waits for one.
#pragma once

#include <future>

#include "lab/status.h"
#include "study/forecast.h"

namespace hooke {

class Forecaster {
 public:
  ~Forecaster() { stop_ = true; }

  // Once per frame: takes a finished forecast, and starts another if the scene was edited since.
  void follow(const Status& status);
  // Another document replaces the scene: earlier forecasts no longer apply.
  void clear();
  const Forecast& newest() const { return newest_; }

 private:
  Forecast newest_;
  // Identifies the scene of the latest forecast, or of the one in progress. Name and counts distinguish documents before their first status
  // arrives.
  struct ForecastKey {
    long edits = -1;
    std::string scene;
    Index points = 0, springs = 0;
    bool operator==(const ForecastKey&) const = default;
  };
  ForecastKey key_;
  bool is_stale_ = false;  // the one in progress belongs to another document
  std::atomic<bool> stop_ = false;
  std::future<Forecast> pending_;  // last: the destructor waits for it before anything that it uses is destroyed
};

}  // namespace hooke
