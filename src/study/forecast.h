// What the numbers of a scene lead to: how far its weight makes it sag, how fast it swings and how fast that dies out.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "sim/state.h"
#include "sim/statics/modes.h"

namespace hooke {

struct Forecast {
  // [m], along gravity, of the point that sags most: where it hangs at rest, below where it would hang if the weight were taken
  // away. None where nothing carries the weight, or where more than springs and weight decide.
  std::optional<double> sag;
  std::optional<Mode> slowest, fastest;  // about where it is at rest
  double drag = 0.0;                     // [1/s]

  // Where it was found at rest, to begin the next one from.
  std::shared_ptr<const System> system;
  std::vector<Vec3> rest;
};

// zeta of x'' + 2 zeta omega x' + omega^2 x = 0, by the dashpots and by the drag; they add up. 1 is critical.
inline double dashpot_ratio(const Mode& mode) { return 0.5 * mode.dashpot_rate / mode.omega; }
inline double drag_ratio(const Mode& mode, double drag) { return 0.5 * drag / mode.omega; }

// Takes a second or two for a cloth of 40 x 40; beyond 1,700 points only the fastest mode is looked for. The hand does not count.
// `before`: an earlier forecast, of this scene with other numbers perhaps, or none.
Forecast make_forecast(std::shared_ptr<const System> system, const State& state, const Forecast& before, const std::atomic<bool>& stop);

}  // namespace hooke
