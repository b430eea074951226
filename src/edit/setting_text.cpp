#include "edit/setting_text.h"

#include <cmath>

#include "base/printable.h"
#include "edit/apply.h"
#include "scene/flatness.h"
#include "scene/parameter_value.h"
#include "sim/integrator.h"

namespace hooke {

std::string ids_of_integrators() {
  std::string ids;
  for (const Integrator& integrator : integrators()) ids += (ids.empty() ? "" : ", ") + std::string(integrator.id);
  return ids;
}

std::string names_of_parameters() {
  std::string names;
  for (const Parameter& parameter : parameters()) names += (names.empty() ? "" : ", ") + std::string(parameter.name);
  return names;
}

const Integrator& parse_integrator(const std::string& id) {
  const Integrator* integrator = find_integrator(id);
  if (integrator == nullptr) throw UsageError("--integrator " + printable(id, 80) + ": must be one of " + ids_of_integrators());
  return *integrator;
}

SetParameter parse_setting(const std::string& setting) {
  const std::string shown = "--set " + printable(setting, 80);
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) throw UsageError(shown + ": must be NAME=VALUE");
  const Parameter* parameter = find_parameter(setting.substr(0, equals));
  if (parameter == nullptr) throw UsageError(shown + ": must name one of " + names_of_parameters());

  const auto value = parse_value(*parameter, std::string_view(setting).substr(equals + 1));
  if (!value) throw UsageError(shown + ": " + limit_text(*parameter));
  return {.parameter = parameter, .value = *value};
}

void apply_setting(Scene& scene, const SetParameter& setting, const std::string& name) {
  if (setting.parameter == &dimensions_parameter && setting.value == 0.0)
    if (const std::string reason = why_not_flat(scene.system, scene.state); !reason.empty())
      throw InputError(printable(name, 80) + ": dimensions: 2: " + reason);
  Effect effect;
  apply(scene, setting, effect);
}

void check_option(const std::string& option, double value, const Bounds& bounds) {
  if (!std::isfinite(value) || !bounds.contains(value)) throw UsageError(option + ": " + format_exact(value) + ": " + bounds.text());
}

}  // namespace hooke
