#include "edit/setting_text.h"

#include "base/printable.h"
#include "edit/command.h"
#include "scene/flatness.h"
#include "scene/parameter_value.h"
#include "sim/methods/integrator.h"

namespace hooke {

const Integrator& parse_integrator(const std::string& id) {
  const Integrator* integrator = find_integrator(id);
  if (integrator == nullptr) throw OptionError("integrator", printable(id, 80), must_be_one_of(ids_of_integrators(), id));
  return *integrator;
}

const Parameter& parse_parameter(const std::string& name) {
  const Parameter* parameter = find_parameter(name);
  if (parameter == nullptr)
    throw OptionError("set", printable(name, 80), "no such parameter: " + must_be_one_of(names_of_parameters(), name));
  return *parameter;
}

SetParameter parse_setting(const std::string& name, const std::string& value) {
  const Parameter& parameter = parse_parameter(name);
  const std::optional<double> parsed = parse_value(parameter, value);
  if (!parsed) throw OptionError("set", printable(name + "=" + value, 80), why_refused(parameter, value));
  return {.parameter = &parameter, .value = *parsed};
}

SetParameter parse_setting(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) throw OptionError("set", printable(setting, 80), "must be NAME=VALUE");
  return parse_setting(setting.substr(0, equals), setting.substr(equals + 1));
}

void apply_setting(Scene& scene, const SetParameter& setting, const std::string& name) {
  if (setting.parameter == &dimensions_parameter && setting.value == 0.0)
    if (const std::string reason = why_not_flat(scene.system, scene.state); !reason.empty())
      throw InputError(printable(name, 80) + ": dimensions: 2: " + reason);
  Effect effect;
  apply(scene, setting, effect);
}

}  // namespace hooke
