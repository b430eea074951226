#include "app/tools/tune.h"

#include <algorithm>
#include <cmath>

#include "scene/parameters.h"
#include "ui/text.h"

namespace hooke {
namespace {

constexpr double factor = 1.1;
constexpr int substeps_at_once = 5;

double stepped(double k, int direction, const ControlRanges& controls, const Parameter& row) {
  if (controls.stiffness_max > 0.0 && controls.stiffness_step > 0.0) {
    const double steps = std::round(k / controls.stiffness_step) + direction;
    return std::clamp(steps * controls.stiffness_step, controls.stiffness_min, controls.stiffness_max);
  }
  return clamp_to(row, direction > 0 ? k * factor : k / factor);
}

std::string value_text(double min, double max) { return "k = " + number(min) + (min < max ? " to " + number(max) : "") + " N/m"; }

}  // namespace

Tuning tune_stiffness(const Status& status, const Selection& selection, int direction) {
  const System& system = *status.snapshot->system;
  const Parameter& row = stiffness_parameter;
  const std::vector<SpringId> affected = affected_springs(system, selection);

  Tuning tuning;
  SetSpringProperty set{SpringProperty::Stiffness, {}};
  double min = INFINITY, max = 0.0;
  const auto include = [&](const Spring& spring) {
    const double k = stepped(spring.stiffness, direction, status.document->controls, row);
    set.values.emplace_back(spring.id, k);
    min = std::min(min, k);
    max = std::max(max, k);
  };
  if (!affected.empty()) {
    for (const SpringId id : affected) include(system.springs()[system.index_of(id)]);
    tuning.message = value_text(min, max) + " (" + count(static_cast<long>(affected.size()), "selected spring") + ")";
  } else {
    for (const Spring& spring : system.springs()) include(spring);
    const double new_stiffness = stepped(status.document->defaults.stiffness, direction, status.document->controls, row);
    tuning.commands.push_back(SetParameter{&new_stiffness_parameter, new_stiffness});
    tuning.message =
        set.values.empty() ? value_text(new_stiffness, new_stiffness) + " (new springs)" : value_text(min, max) + " (all springs)";
  }
  if (!set.values.empty()) tuning.commands.insert(tuning.commands.begin(), set);
  return tuning;
}

Tuning tune_substeps(const Status& status, int direction) {
  const Parameter& row = substeps_parameter;
  const int now = status.snapshot->settings.substeps;
  // the next multiple in that direction
  const int steps = direction > 0 ? now / substeps_at_once + 1 : (now + substeps_at_once - 1) / substeps_at_once - 1;
  const double next = clamp_to(row, steps * substeps_at_once);
  return {{SetParameter{&row, next}}, count(static_cast<long>(next), "substep") + " per frame"};
}

Tuning tune_speed(const Status& status, double times) {
  const Parameter& row = speed_parameter;
  const double next = clamp_to(row, times * status.snapshot->settings.speed);
  return {{SetParameter{&row, next}}, number(next) + "\u00d7 real time"};
}

}  // namespace hooke
