#include "scene/parameter_value.h"

#include "base/text_lines.h"
#include "sim/control/automatic.h"

namespace hooke {

std::string ids_of_integrators() { return joined(integrators(), &Integrator::id) + ", " + std::string(automatic_method().id); }
std::string names_of_parameters() { return joined(parameters(), &Parameter::name); }

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
  const std::optional<double> value = parse_number(text);
  const bool is_valid = value && allowed_range(parameter).contains(*value) && clamp_to_range(parameter, *value) == *value;
  return is_valid ? value : std::nullopt;
}

std::string limit_text(const Parameter& parameter) {
  if (parameter.kind == Parameter::Kind::Switch) return "must be on or off";
  if (parameter.kind == Parameter::Kind::Choice) return "must be one of " + joined(parameter.choices, &ParameterChoice::id);
  return (parameter.kind == Parameter::Kind::Integer ? "must be whole, and " : "") + allowed_range(parameter).text() +
         (parameter.unit.empty() ? "" : " [" + std::string(parameter.unit) + "]");
}

std::string why_refused(const Parameter& parameter, std::string_view text) {
  return (parameter.is_number() && !parse_number(text) ? "not a number: " : "") + limit_text(parameter);
}

std::string value_text(const Parameter& parameter, double value) {
  if (parameter.kind == Parameter::Kind::Switch) return value != 0.0 ? "on" : "off";
  if (parameter.kind == Parameter::Kind::Choice) return std::string(parameter.choices[static_cast<std::size_t>(value)].id);
  return format_exact(value);
}

}  // namespace hooke
