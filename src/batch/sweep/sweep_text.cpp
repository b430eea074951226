// What a sweep varies and measures, as given on the command line.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/formatted.h"
#include "base/option_error.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "batch/sweep/sweep.h"
#include "edit/setting_text.h"
#include "scene/parameter_value.h"

namespace hooke {
namespace {

using Of = SweepMeasure::Of;

constexpr std::array prefixes{std::pair{std::string_view("max:"), Of::Max}, std::pair{std::string_view("min:"), Of::Min},
                              std::pair{std::string_view("mean:"), Of::Mean}};

// The same on every machine, whatever its powers and logarithms round to, and readable.
double to_twelve_digits(double value) { return parse_number(formatted("%.12g", value)).value(); }

// "100:1e4:log:20": from, to, spacing, number.
std::string parse_range(const std::vector<std::string_view>& parts, SweepAxis& axis) {
  const Parameter& parameter = *axis.parameter;
  if (!parameter.is_number()) return limit_text(parameter) + ", separated by commas";
  if (parts.size() != 4 || (parts[2] != "log" && parts[2] != "lin")) return "a range must be MIN:MAX:log:COUNT or MIN:MAX:lin:COUNT";
  const auto first = parse_value(parameter, parts[0]), last = parse_value(parameter, parts[1]);
  for (const auto& [value, text] : {std::pair{first, parts[0]}, std::pair{last, parts[1]}})
    if (!value) return printable(text, 80) + ": " + why_refused(parameter, text);
  const bool is_log = parts[2] == "log";
  if (is_log && !(std::min(*first, *last) > 0.0)) return "the ends of a logarithmic range must be more than 0";
  if (*first == *last) return "the ends of a range must differ";

  const int count = parse_integer(parts[3]).value_or(0);
  if (count < 2 || count > static_cast<int>(max_sweep_rows))
    return printable(parts[3], 80) + ": the number of values must be from 2 to " + std::to_string(max_sweep_rows);

  for (int i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / (count - 1);
    double value = is_log ? *first * std::pow(*last / *first, part) : *first + part * (*last - *first);
    value = i == 0 ? *first : i == count - 1 ? *last : clamp_to_range(parameter, to_twelve_digits(value));
    // whole numbers that are close together round to the same one
    if (axis.values.empty() || axis.values.back() != value) axis.values.push_back(value);
  }
  return {};
}

}  // namespace

std::string parse_axis(std::string_view text, SweepAxis& axis) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return "must be NAME=VALUES";
  const std::string_view name = text.substr(0, equals);
  axis.parameter = find_parameter(name);
  if (axis.parameter == nullptr) return "no such parameter: " + must_be_one_of(names_of_parameters(), name);
  text.remove_prefix(equals + 1);
  if (text.find(':') != std::string_view::npos) return parse_range(split(text, ':'), axis);

  for (const std::string_view word : split(text, ',')) {
    if (word.empty()) return "a value is missing";
    const auto value = parse_value(*axis.parameter, word);
    if (!value) return printable(word, 80) + ": " + why_refused(*axis.parameter, word);
    if (std::ranges::count(axis.values, *value) > 0) return printable(word, 80) + ": is repeated";
    axis.values.push_back(*value);
  }
  return {};
}

std::string parse_measures(std::string_view list, Index points, Index springs, std::vector<SweepMeasure>& measures) {
  for (const std::string_view word : split(list, ',')) {
    SweepMeasure measure{.name = std::string(word)};
    std::string_view name = word;
    for (const auto& [prefix, of] : prefixes) {
      if (!word.starts_with(prefix)) continue;
      measure.of = of;
      name.remove_prefix(prefix.size());
    }
    if (name != "cpu" || measure.of != Of::End) {
      measure.quantity = find_quantity(name, points, springs);
      if (!measure.quantity) return printable(word, 80) + ": " + must_be_one_of(measure_names(), name);
    }
    if (std::ranges::count(measures, measure.name, &SweepMeasure::name) > 0) return printable(word, 80) + ": is repeated";
    measures.push_back(std::move(measure));
  }
  return {};
}

std::string measure_names() { return "cpu, " + quantity_names() + "; with max:, min: or mean: over the run, else at its end"; }

}  // namespace hooke
