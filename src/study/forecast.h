// Predictions from the parameters of a scene: its sag under its weight, its vibration frequencies and their damping.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "sim/model/state.h"
#include "sim/statics/modes.h"

namespace hooke {

struct Forecast {
  // [m], along gravity, of the point that sags most: from the equilibrium without weight to the one with it. None if the weight is not
  // supported, or if more than springs and weight determine the equilibrium.
  std::optional<double> sag;
  std::string why_no_sag{};              // "no point is nailed"; empty where there is a sag or no spring
  std::optional<Mode> slowest, fastest;  // about the equilibrium
  double drag = 0.0;                     // [1/s]

  // The equilibrium, as initial guess for the next forecast.
  std::shared_ptr<const System> system;
  std::vector<Vec3> rest;
  std::vector<Vec3> unloaded{};  // the equilibrium without weight, if there is a sag
};

// Damping ratio zeta of x'' + 2 zeta omega x' + omega^2 x = 0 by the dashpots and by the drag; they add. 1 is critical.
inline double dashpot_ratio(const Mode& mode) { return 0.5 * mode.dashpot_rate / mode.omega; }
inline double drag_ratio(const Mode& mode, double drag) { return 0.5 * drag / mode.omega; }

// The equilibrium of a cloth of this size takes a second or two; that of a larger one often takes ten times as long.
inline constexpr Index max_forecast_points = 1700;

// Takes a second or two for a cloth of 40 x 40; beyond `max_points` only the fastest mode is computed. The hand is ignored. `before`: an
// earlier forecast, possibly of this scene with other parameters, or an empty one.
Forecast make_forecast(const std::shared_ptr<const System>& system, const State& state, const Forecast& before,
                       const std::atomic<bool>& stop, Index max_points = max_forecast_points);

}  // namespace hooke
