// What is computed about the scene on screen, most of it in background threads.
#pragma once

#include <mutex>

#include "app/view/arrows.h"
#include "app/work/followed_result.h"
#include "app/work/ghost_runs.h"
#include "app/work/result_task.h"
#include "lab/crossing_finder.h"
#include "study/forecast.h"

namespace hooke {

struct BackgroundWork {
  // Name and counts distinguish documents before their first status arrives.
  struct ForecastKey {
    long edits;
    std::string scene;
    Index points, springs;
    bool operator==(const ForecastKey&) const = default;
  };
  struct AdviceKey {
    long edits;
    Settings settings;
    const System* system;
    bool operator==(const AdviceKey&) const = default;
  };
  struct FailureKey {
    double time;
    long edits;
    const Scene* start;
    bool operator==(const FailureKey&) const = default;
  };
  // What the search for a remedy is testing.
  struct TestText {
    mutable std::mutex mutex;
    std::string text;  // guarded by mutex
  };
  FollowedResult<ForecastKey, Forecast, true> forecast;
  CrossingFinder crossings;
  ForceArrows force_arrows;
  FollowedResult<AdviceKey, std::optional<CostAdvice>> advice;
  TestText test;
  FollowedResult<FailureKey, std::optional<Remedy>> remedy;
  ResultTask<MethodComparison> comparison;
  ResultTask<ResultCheck> result_check;
  ResultTask<StretchBreakdown> stretch;
  GhostRuns ghosts;

  // Once per frame.
  void follow(const Status& status, const Panels& panels, LabThread& lab);
  // About the present state.
  void start_comparison(const Status& status);
  void start_result_check(const Status& status);
  void start_stretch(const Status& status, const std::vector<SpringId>& springs);
  // Another scene is about to replace the one on screen.
  void clear(const Status& status, LabThread& lab);
  BackgroundResults results() const;
  bool is_running() const { return remedy.is_running() || comparison.is_running() || result_check.is_running() || stretch.is_running(); }
};

}  // namespace hooke
