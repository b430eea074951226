#include "edit/setting_text.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "base/printable.h"
#include "edit/apply.h"
#include "scene/flatness.h"
#include "scene/parameters.h"
#include "sim/integrator.h"

namespace hooke {
namespace {

std::string ids_of_choices(const Parameter& parameter) {
  std::string ids;
  for (const ParameterChoice& choice : parameter.choices) ids += (ids.empty() ? "" : ", ") + std::string(choice.id);
  return ids;
}

// The id of a choice; "0.5", and for switches also "on" and "off".
std::optional<double> parse_value(const Parameter& parameter, std::string_view text) {
  if (parameter.kind == Parameter::Kind::Switch) {
    if (text == "on" || text == "true" || text == "1") return 1.0;
    if (text == "off" || text == "false" || text == "0") return 0.0;
    return std::nullopt;
  }
  if (parameter.kind == Parameter::Kind::Choice) {
    for (std::size_t i = 0; i < parameter.choices.size(); ++i)
      if (text == parameter.choices[i].id) return static_cast<double>(i);
    return std::nullopt;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

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
  if (parameter->kind == Parameter::Kind::Switch && !value) throw UsageError(shown + ": must be on or off");
  if (parameter->kind == Parameter::Kind::Choice && !value) throw UsageError(shown + ": must be one of " + ids_of_choices(*parameter));
  const Bounds range{.min = parameter->min, .max = parameter->max};
  if (!value || !range.contains(*value) || clamp_to(*parameter, *value) != *value)
    throw UsageError(shown + ": " + (parameter->kind == Parameter::Kind::Integer ? "must be whole, and " : "") + range.text() +
                     (parameter->unit.empty() ? "" : " [" + std::string(parameter->unit) + "]"));
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
