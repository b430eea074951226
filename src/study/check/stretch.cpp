#include "study/check/stretch.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/control/frame_error.h"
#include "sim/forces/energy/energy.h"
#include "study/check/copies.h"

namespace hooke {
namespace {

double strain_at(const System& system, const std::vector<Vec3>& places, const Spring& spring) {
  const double length = glm::distance(places[system.index_of(spring.first)], places[system.index_of(spring.second)]);
  return spring.rest_length > 0.0 ? length / spring.rest_length - 1.0 : 0.0;
}

// `limit`: a spring is at most this much longer than its rest length.
double mean_strain(const System& system, const std::vector<Vec3>& places, const std::vector<Index>& springs, double limit = HUGE_VAL) {
  double sum = 0.0;
  for (const Index s : springs) sum += std::min(limit, strain_at(system, places, system.springs()[s]));
  return springs.empty() ? 0.0 : sum / static_cast<double>(springs.size());
}

// The root mean square over frames and springs of the difference between runs with the step and with half of it.
std::optional<double> step_error(const System& system, const State& state, const Settings& settings, const std::vector<Index>& springs,
                                 double seconds, const Part& part) {
  Lab run(scene_of(system, state, settings), KeepStart::No), half(scene_of(system, state, refined(system, settings)), KeepStart::No);
  std::vector<std::vector<Vec3>> places;
  if (!run_frames(run, seconds, part.within(0.0, 0.33), [&](const Scene& now) { places.push_back(now.state.position); }))
    return std::nullopt;
  double sum = 0.0;
  std::size_t frame = 0;
  const bool finished = run_frames(half, seconds, part.within(0.33, 1.0), [&](const Scene& now) {
    const std::vector<Vec3>& other = places[frame++];
    if (other.size() != now.state.position.size()) return;
    for (const Index s : springs)
      sum += std::pow(strain_at(system, other, system.springs()[s]) - strain_at(system, now.state.position, system.springs()[s]), 2);
  });
  if (!finished || frame == 0 || springs.empty()) return std::nullopt;
  return refinement_weight(system, settings) * std::sqrt(sum / static_cast<double>(frame * springs.size()));
}

}  // namespace

StretchBreakdown explain_stretch(const System& system, const State& state, const Settings& settings, const std::vector<SpringId>& ids,
                                 const Progress& progress) {
  std::vector<Index> springs;
  for (const SpringId id : ids)
    if (const Index s = system.index_of(id); s != no_index) springs.push_back(s);
  StretchBreakdown stretch{.springs = ids, .now = mean_strain(system, state.position, springs), .seconds = 0.5};
  try {
    // the equilibrium without limits, and without what a forecast cannot contain
    System unlimited = system;
    unlimited.strain_limit = unlimited.break_strain = 0.0;
    unlimited.grab.reset();
    const Forecast forecast = forecast_of(unlimited, state, Part(progress, 0.0, 0.2));
    if (forecast.rest.empty() || !forecast.slowest) {
      stretch.why_no_load = forecast.why_no_sag.empty() ? "no equilibrium found" : forecast.why_no_sag;
    } else {
      stretch.load = mean_strain(system, forecast.rest, springs);
      const auto settled = settle(unlimited, state, settings, forecast, Part(progress, 0.2, 0.5));
      const std::vector<Vec3>& rest = settled ? *settled : forecast.rest;
      const double at_rest = mean_strain(system, rest, springs);
      if (settled) stretch.solver = at_rest - *stretch.load;
      double limited = at_rest;
      if (system.strain_limit > 0.0) {
        limited = mean_strain(system, rest, springs, system.strain_limit);
        stretch.limit = limited - at_rest;
      }
      stretch.motion = stretch.now - limited;
    }
    stretch.step_error = step_error(system, state, settings, springs, stretch.seconds, Part(progress, 0.5, 1.0));
  } catch (const Stopped&) {
  }
  return stretch;
}

}  // namespace hooke
