#include "app/tools/tune.h"

#include <algorithm>
#include <cmath>

#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "ui/text.h"

namespace hooke {
namespace {

constexpr double factor = 1.1;
constexpr int substeps_at_once = 5;

// The next stiffness: by the step that the scene gives, else by a factor.
struct StiffnessStep {
  const ControlRanges& controls;
  double factor;
  int direction;

  double operator()(double k) const {
    if (controls.stiffness_max <= 0.0 || controls.stiffness_step <= 0.0) return factor * k;
    const double steps = std::round(k / controls.stiffness_step) + direction;
    return std::clamp(steps * controls.stiffness_step, controls.stiffness_min, controls.stiffness_max);
  }
};

// One factor for all, so that the ratios of different values stay: at the end of the range it is nearer to 1. Springs without stiffness
// keep none.
double common_factor(double min, double max, int direction) {
  const Parameter& row = stiffness_parameter;
  return direction > 0 ? std::max(1.0, std::min(factor, row.max / max)) : std::min(1.0, std::max(1.0 / factor, row.min / min));
}

std::string value_text(double min, double max) { return "k = " + number_text(min) + (min < max ? " to " + number_text(max) : "") + " N/m"; }

// Keys lead to the ends of the slider. A value beyond, which was typed or is of a file, does not change against the direction of the key.
double tuned(const Parameter& row, double now, double next) { return std::clamp(next, std::min(row.min, now), std::max(row.max, now)); }

}  // namespace

Tuning tune_stiffness(const Status& status, const Selection& selection, int direction) {
  const System& system = *status.snapshot->system;
  const ControlRanges& controls = status.document->controls;
  if (system.spring_count() == 0) {
    const double now = status.document->defaults.stiffness;
    const double k = StiffnessStep{controls, common_factor(now, now, direction), direction}(now);
    return {{SetParameter{&new_stiffness_parameter, k}}, value_text(k, k) + " (new springs)"};
  }

  const std::vector<SpringId> selected = affected_springs(system, selection);
  std::vector<Spring> affected;
  for (const SpringId id : selected) affected.push_back(system.springs()[system.index_of(id)]);
  if (selected.empty()) affected = system.springs();

  double min = INFINITY, max = 0.0;
  for (const Spring& spring : affected) {
    if (spring.stiffness > 0.0) min = std::min(min, spring.stiffness);
    max = std::max(max, spring.stiffness);
  }
  const StiffnessStep next{controls, max > 0.0 ? common_factor(min, max, direction) : 1.0, direction};
  SetSpringProperty set{SpringProperty::Stiffness, {}};
  min = INFINITY;
  max = 0.0;
  for (const Spring& spring : affected) {
    const double k = next(spring.stiffness);
    set.values.emplace_back(spring.id, k);
    min = std::min(min, k);
    max = std::max(max, k);
  }
  const std::string which = selected.empty() ? "all springs" : count(static_cast<long>(selected.size()), "selected spring");
  return {{std::move(set)}, value_text(min, max) + " (" + which + ")"};
}

Tuning tune_substeps(const Status& status, int direction) {
  if (is_automatic(status.snapshot->settings)) {
    const double now = automatic_tolerance(status.snapshot->settings);
    const double tolerance = tuned(tolerance_parameter, now, now * (direction > 0 ? 0.5 : 2.0));
    return {{SetParameter{&tolerance_parameter, tolerance}}, "Tolerance " + number_text(tolerance) + " m/s"};
  }
  const int now = status.snapshot->settings.substeps;
  // the next multiple in that direction
  const int steps = direction > 0 ? now / substeps_at_once + 1 : (now + substeps_at_once - 1) / substeps_at_once - 1;
  const double next = tuned(substeps_parameter, now, steps * substeps_at_once);
  return {{SetParameter{&substeps_parameter, next}}, count(static_cast<long>(next), "substep") + " per frame"};
}

Tuning tune_speed(const Status& status, double times) {
  const double now = status.snapshot->settings.speed, next = tuned(speed_parameter, now, times * now);
  return {{SetParameter{&speed_parameter, next}}, number_text(next) + "\u00d7 real time"};
}

}  // namespace hooke
