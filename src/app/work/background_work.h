// What is computed about the scene on screen, most of it in background threads.
#pragma once

#include "app/work/forecaster.h"
#include "app/work/ghost_runs.h"
#include "app/work/method_advisor.h"
#include "app/work/remedy_search.h"
#include "app/work/result_task.h"
#include "lab/crossing_finder.h"

namespace hooke {

struct BackgroundWork {
  Forecaster forecaster;
  CrossingFinder crossings;
  MethodAdvisor advisor;
  RemedySearch remedy;
  ResultTask<MethodComparison> comparison;
  ResultTask<ResultCheck> result_check;
  ResultTask<StretchBreakdown> stretch;
  GhostRuns ghosts;

  void follow(const Status& status, const Panels& panels, LabThread& lab) {
    forecaster.follow(status);
    crossings.follow(status);
    advisor.follow(status, panels.shown.accuracy);
    comparison.follow();
    result_check.follow();
    stretch.follow();
    ghosts.follow(status, lab);
    const auto& failure = status.snapshot->divergence;
    remedy.follow(status, failure && panels.banners.dismissed != failure->time);
  }
  // Another scene is about to replace the one on screen.
  void clear(const Status& status, LabThread& lab) {
    forecaster.clear();
    ghosts.set({}, status, lab);
    comparison.clear();
    result_check.clear();
    stretch.clear();
  }
  BackgroundResults results() const {
    return {&forecaster.newest(), advisor.newest(), remedy.status(), comparison.status(), result_check.status(), stretch.status()};
  }
  bool is_running() const { return remedy.is_running() || comparison.is_running() || result_check.is_running() || stretch.is_running(); }
};

}  // namespace hooke
