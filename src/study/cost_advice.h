// Which other settings would be more accurate, or cheaper, from the present state on: each is measured on copies, frame by frame at the
// frame rate of the scene.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

// Settings that were run, relative to the present ones.
struct TestedCost {
  Settings settings;
  double error = 1.0;  // [1], largest RMS error of a point at the end of a frame, from the state for which it is worst
  double cost = 1.0;   // [1], CPU time
};

struct CostAdvice {
  std::optional<TestedCost> half_error;  // of the present method, with at most half the error
  std::optional<TestedCost> cheaper;     // another method with no larger error
  std::optional<TestedCost> better;      // another method with far less error for about the same time
};

// Only methods that are more than this many times cheaper, or this many times more accurate, are worth a change.
inline constexpr double worthwhile_saving = 1.5, worthwhile_accuracy = 10.0;
// About the same time [1].
inline constexpr double max_same_cost = 1.25;

// Computes the frames that follow `state`, and those that follow two later states of the run, with other settings; nothing is advised where
// no other is good enough, or when `stop` becomes true. Takes some hundred times as long as these frames.
CostAdvice advise_on_cost(const System& system, const State& state, const Settings& settings, const std::atomic<bool>& stop);

// "Blanes-Moan 4, 3 substeps: 9000 times less error, 1.1 times the time"
std::string describe(const TestedCost& tested, const Settings& present);

}  // namespace hooke
