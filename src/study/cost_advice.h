// Which other settings would be more accurate, or cheaper, from the present state on: each is measured on copies, frame by frame at the
// frame rate of the scene.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "scene/scene.h"
#include "sim/model/accuracy.h"

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

// Repeats a run from its start with a tolerance that may be small enough, which takes up to a second or two: "With auto and a tolerance of
// 0.02 m/s, a copy of this run has an accumulated error of at most 3.1 mm." None where no tolerance helps, or this one takes too long or
// leaves more than half of the error.
std::optional<std::string> advise_on_tolerance(Scene start, long frames, const Accuracy& accuracy);

// "Blanes-Moan 4, 3 substeps: 9000 times less error, 1.1 times the time"
std::string describe(const TestedCost& tested, const Settings& present);

}  // namespace hooke
