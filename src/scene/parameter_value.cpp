#include "scene/parameter_value.h"

#include <charconv>
#include <cmath>

namespace hooke {

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
  const Bounds range{.min = parameter.min, .max = parameter.max};
  const bool is_valid = error == std::errc() && end == text.data() + text.size() && std::isfinite(value) && range.contains(value) &&
                        clamp_to(parameter, value) == value;
  return is_valid ? std::optional(value) : std::nullopt;
}

std::string limit_text(const Parameter& parameter) {
  if (parameter.kind == Parameter::Kind::Switch) return "must be on or off";
  if (parameter.kind == Parameter::Kind::Choice) {
    std::string ids;
    for (const ParameterChoice& choice : parameter.choices) ids += (ids.empty() ? "" : ", ") + std::string(choice.id);
    return "must be one of " + ids;
  }
  const Bounds range{.min = parameter.min, .max = parameter.max};
  return (parameter.kind == Parameter::Kind::Integer ? "must be whole, and " : "") + range.text() +
         (parameter.unit.empty() ? "" : " [" + std::string(parameter.unit) + "]");
}

std::string value_text(const Parameter& parameter, double value) {
  if (parameter.kind == Parameter::Kind::Switch) return value != 0.0 ? "on" : "off";
  if (parameter.kind == Parameter::Kind::Choice) return std::string(parameter.choices[static_cast<std::size_t>(value)].id);
  return format_exact(value);
}

}  // namespace hooke
