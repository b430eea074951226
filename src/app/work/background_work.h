// What is computed about the scene on screen, most of it in background threads.
#pragma once

#include <mutex>
#include <string>
#include <tuple>

#include "app/view/arrows.h"
#include "app/work/followed_result.h"
#include "app/work/ghost_runs.h"
#include "app/work/result_task.h"
#include "lab/crossing_finder.h"
#include "study/forecast.h"

namespace hooke {

struct BackgroundWork {
  // Edits, and what distinguishes documents before their first status arrives: the name, and the numbers of points and springs.
  using ForecastKey = std::tuple<long, std::string, Index, Index>;
  using AdviceKey = std::tuple<long, Settings, const System*>;  // edits first
  using FailureKey = std::tuple<double, long, const Scene*>;    // time [s], edits, start
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
