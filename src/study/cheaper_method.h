// Which other method makes no larger error in the present frame for less time: measured, on copies.
#pragma once

#include <atomic>
#include <optional>

#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

struct CheaperMethod {
  const Integrator* integrator = nullptr;
  int substeps = 1;
  double error = 0.0;  // [m], of the frame, RMS over the points
  double cost = 1.0;   // [1], time of the frame relative to that with the present settings
};

// Only methods that are more than this many times cheaper are worth a change.
inline constexpr double worthwhile_saving = 1.5;

// Computes the frame that follows `state` with other methods and steps; none if no method is cheap enough, or when `stop` becomes true.
// Takes some hundred times as long as the frame.
std::optional<CheaperMethod> find_cheaper_method(const System& system, const State& state, const Settings& settings,
                                                 const std::atomic<bool>& stop);

}  // namespace hooke
