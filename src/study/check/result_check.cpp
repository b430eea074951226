#include "study/check/result_check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "scene/quantity.h"
#include "scene/step_advice.h"
#include "sim/control/frame_error.h"
#include "sim/model/bounding_box.h"
#include "study/check/copies.h"
#include "study/check/finer_network.h"

namespace hooke {
namespace {

constexpr Index max_finer_points = 50'000;

// The scene in one of its versions, with what is measured on it.
struct Version {
  System system;
  State state;
  Settings settings;
  std::shared_ptr<const Forecast> forecast{};  // null: not computed yet

  std::optional<double> sag{}, period{}, strain{}, energy_change{};
  std::string why_no_sag{}, why_no_period{};
  double energy_scale = 0.0;  // [J]
  std::vector<Vec3> end{};
  bool has_diverged = false;
};

void measure_run(Version& version, double seconds, const Part& part) {
  Lab lab(scene_of(version.system, version.state, version.settings), KeepStart::No);
  const double before = compute_energy(lab.scene().system, lab.scene().state).total();
  double strain = 0.0;
  version.has_diverged = !run_frames(
      lab, seconds, part, [&](const Scene& scene) { strain = std::max(strain, measure(scene.system, scene.state).largest_strain); });
  if (version.has_diverged) return;
  version.strain = strain;
  version.energy_change = compute_energy(lab.scene().system, lab.scene().state).total() - before;
  version.energy_scale = lab.scene().state.supply.scale;
  version.end = lab.scene().state.position;
}

// The first zero in [0, 1] of the cubic with these values and slopes (per unit) at its ends, which change sign.
double zero_between(double from, double slope_from, double to, double slope_to) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.5 * (low + high), s = 1.0 - t;
    const double value = (1.0 + 2.0 * t) * s * s * from + t * s * s * slope_from + t * t * (3.0 - 2.0 * t) * to - t * t * s * slope_to;
    ((value < 0.0) == (from < 0.0) ? low : high) = t;
  }
  return 0.5 * (low + high);
}

// The time between zeros in the same direction of a small vibration in the slowest mode about `rest`, as the method computes it.
void measure_period(Version& version, const std::vector<Vec3>& rest, const Part& part) {
  const Mode& mode = *version.forecast->slowest;
  const double expected = 2.0 * std::numbers::pi / mode.omega;
  const auto points = static_cast<std::size_t>(version.system.point_count());
  const auto shape = [&](std::size_t i) {
    Vec3 u(0.0);
    for (int c = 0; c < version.system.dimensions; ++c) u[c] = mode.shape[static_cast<std::size_t>(c) * points + i];
    return u;
  };
  constexpr double max_seconds = 60.0;
  if (2.0 * expected > max_seconds) {
    version.why_no_period = "longer than 30 s";
    return;
  }

  // at most an eighth of a period per frame, with the same step
  Scene scene = resting_scene(version.system, version.state, version.settings, *version.forecast);
  const double h = scene.settings.substep();
  scene.settings.substeps = static_cast<int>(std::clamp(std::floor(expected / (8.0 * h)), 1.0, double(scene.settings.substeps)));
  scene.settings.frame_rate = 1.0 / (h * scene.settings.substeps);
  double largest = 0.0, extent = 0.0;
  for (std::size_t i = 0; i < points; ++i) {
    largest = std::max(largest, glm::length(shape(i)));
    extent = std::max(extent, glm::distance(rest[i], rest[0]));
  }
  // small enough for linear theory, and far above round-off
  constexpr double amplitude = 1e-4;
  for (std::size_t i = 0; i < points; ++i) scene.state.position[i] = rest[i] + amplitude * extent / largest * shape(i);

  double q = 1.0, dq = 0.0;
  std::vector<double> zeros;
  Lab lab(std::move(scene), KeepStart::No);
  const double start = lab.scene().state.time, frame = 1.0 / lab.scene().settings.frame_rate;
  const bool finished = run_frames(lab, 1.85 * expected, part, [&](const Scene& now) {
    double next = 0.0, slope = 0.0;
    for (std::size_t i = 0; i < points; ++i) {
      const Vec3 u = now.system.points()[i].mass * shape(i);
      next += glm::dot(u, now.state.position[i] - rest[i]);
      slope += glm::dot(u, now.state.velocity[i]) * frame;
    }
    if (zeros.empty() && now.state.time < start + 1.5 * frame) q = next, dq = slope;
    if ((next < 0.0) != (q < 0.0)) zeros.push_back(now.state.time - frame + frame * zero_between(q, dq, next, slope));
    q = next, dq = slope;
  });
  // at a quarter, three quarters and five quarters of a period
  if (finished && zeros.size() >= 3)
    version.period = zeros[2] - zeros[0];
  else
    version.why_no_period = finished ? "it does not vibrate" : "the run diverges";
}

void measure_equilibrium(Version& version, const Part& part) {
  const Forecast& forecast = *version.forecast;
  if (!forecast.sag) version.why_no_sag = forecast.why_no_sag.empty() ? "no equilibrium found" : forecast.why_no_sag;
  version.why_no_period = "no equilibrium found";
  if (!forecast.slowest || forecast.rest.empty() || forecast.slowest->shape.empty()) {
    if (forecast.sag) version.why_no_sag = "no vibration found";
    return;
  }
  const auto rest = settle(version.system, version.state, version.settings, forecast, part.within(0.0, 0.5));
  if (!rest) {
    version.why_no_sag = version.why_no_period = "the run diverges";
    return;
  }
  if (forecast.sag) {
    const Vec3 down = glm::normalize(version.system.gravity);
    double sag = 0.0;
    for (std::size_t i = 0; i < rest->size(); ++i) sag = std::max(sag, glm::dot(down, (*rest)[i] - forecast.unloaded[i]));
    version.sag = sag;
  }
  const double ratio = dashpot_ratio(*forecast.slowest) + drag_ratio(*forecast.slowest, forecast.drag);
  if (ratio >= 1.0)
    version.why_no_period = "overdamped";
  else
    measure_period(version, *rest, part.within(0.5, 1.0));
}

void compare(const Version& now, const Version& half, const Version* finer, ResultCheck& check) {
  const auto add = [&](std::string_view name, std::string_view unit, std::optional<double> Version::*value, double scale,
                       const std::string& why) {
    check.quantities.push_back({.name = name,
                                .unit = unit,
                                .now = now.*value,
                                .half_step = half.*value,
                                .finer = finer != nullptr ? finer->*value : std::nullopt,
                                .why_unknown = why,
                                .scale = scale});
  };
  const auto first_reason = [&](std::string Version::*why) {
    for (const Version* version : {&now, &half, finer})
      if (version != nullptr && !(version->*why).empty()) return version->*why;
    return std::string();
  };
  constexpr double small_length = 1e-3, small_strain = 1e-3;
  add("sag", "m", &Version::sag, small_length * check.size, first_reason(&Version::why_no_sag));
  add("period", "s", &Version::period, 0.0, first_reason(&Version::why_no_period));
  add("maximum strain", "1", &Version::strain, small_strain, "the run diverges");
  add("energy change", "J", &Version::energy_change, now.energy_scale, "the run diverges");
}

// The equilibrium of the finer network, from that of the scene.
Forecast refined_guess(const Forecast& forecast, const System& system, State state) {
  if (forecast.rest.empty()) return {};
  state.position = forecast.rest;
  auto network = refine_network(system, state, max_finer_points);
  if (!network) return {};
  return {.system = std::make_shared<const System>(std::move(network->system)), .rest = std::move(network->state.position)};
}

}  // namespace

ResultCheck check_result(const System& system, const State& state, const Settings& settings, double seconds, const Progress& progress,
                         const Forecast& before) {
  ResultCheck check{.seconds = seconds};
  if (system.point_count() == 0) {
    check.note = "There is nothing to check: the scene has no points.";
    return check;
  }
  if (const auto warning = oscillation_warning(system, settings)) {
    check.note = "Not checked, because half the step may be as wrong: " + *warning + ".";
    return check;
  }
  check.size = std::max(bounding_box(state.position).longest_side(), 1e-300);
  Version now{system, state, settings}, half{system, state, refined(system, settings)};
  half.state.memory = {};
  std::optional<Version> finer;
  if (auto network = refine_network(system, state, max_finer_points)) {
    check.sheets = network->sheets;
    check.ropes = network->ropes;
    finer = Version{std::move(network->system), std::move(network->state), half.settings};
  } else {
    check.why_not_finer = "no sheet or rope to refine";
  }
  // about in proportion to the work
  const double whole = finer ? 11.0 : 3.0;
  const auto work = [&](Version& version, double begin, double end, const Forecast& guess) {
    const Part part(progress, begin / whole, end / whole);
    measure_run(version, seconds, part.within(0.0, 0.5));
    if (version.has_diverged) return;
    if (!version.forecast)
      version.forecast = std::make_shared<const Forecast>(forecast_of(version.system, version.state, part.within(0.5, 0.6), guess));
    measure_equilibrium(version, part.within(0.6, 1.0));
  };
  try {
    work(now, 0.0, 1.0, before);
    if (now.has_diverged) {
      check.note = "The run diverges: use more substeps first.";
      return check;
    }
    half.forecast = now.forecast;
    work(half, 1.0, 3.0, {});
    if (finer) work(*finer, 3.0, 11.0, refined_guess(*now.forecast, system, state));
  } catch (const Stopped&) {
    check.note = "Stopped.";
    return check;
  }
  if (!now.end.empty() && now.end.size() == half.end.size()) check.distance = weighted_distance(system, now.end, half.end, 1.0).rms;
  compare(now, half, finer ? &*finer : nullptr, check);
  return check;
}

}  // namespace hooke
