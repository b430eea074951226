// What runs beside the run on screen is asked to be, and what is published about it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/model/settings.h"
#include "sim/model/state.h"

namespace hooke {

struct Companion {
  std::string name;     // in the legend
  Settings settings{};  // the frame rate is that of the run
};

// RMS distance from the run over the points [m].
struct CompanionTable {
  std::vector<double> times;                   // [s], ascending
  std::vector<std::vector<double>> distances;  // of each companion, one for each time; NaN after it has stopped
};

struct CompanionStatus {
  std::string name;
  std::shared_ptr<const std::vector<Vec3>> positions;  // [m]; null: not started yet
  double distance = 0.0;                               // [m], now
  bool has_diverged = false;
};

struct CompanionsStatus {
  double since = 0.0;  // [s], when they started from the state of the run
  std::vector<CompanionStatus> list;
  std::shared_ptr<const CompanionTable> table;  // null: no frame yet
};

}  // namespace hooke
