#include "base/option_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace hooke {
namespace {

std::string with_underscores(std::string option) {
  std::ranges::replace(option, '-', '_');
  return option;
}

// The number of characters to insert, delete or replace, or neighbors to exchange (Damerau, 1964), row by row.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1), above, second_above;
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    second_above = std::exchange(above, row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({above[j] + (a[i] == b[j] ? 0 : 1), row[j] + 1, above[j + 1] + 1});
      if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j]) row[j + 1] = std::min(row[j + 1], second_above[j - 1] + 1);
    }
  }
  return row.back();
}

// A lower value is more similar; a name that is part of the other one is similar, however long that is.
std::size_t difference(std::string_view name, std::string_view choice) {
  constexpr std::size_t min_part = 4;
  if (name.size() >= min_part && choice.find(name) != std::string_view::npos) return 1;
  return edit_distance(name, choice);
}

}  // namespace

OptionError::OptionError(const std::string& option, const std::string& text)
    : UsageError("--" + option + " " + text), reason_(text), as_argument_(with_underscores(option) + ": " + text) {}

OptionError::OptionError(const std::string& option, const std::string& value, const std::string& reason)
    : OptionError(option, value + ": " + reason) {
  reason_ = reason;
}

std::string why_refused(double value, const Bounds& bounds) {
  if (!std::isfinite(value)) return "must be a finite number";
  if (bounds.contains(value)) return "";
  const bool is_denormal = value > bounds.min && value < std::numeric_limits<double>::min();
  return bounds.text() + (is_denormal ? "; numbers below 2.3e-308 count as 0" : "");
}

void check_value(const std::string& field, double value, const Bounds& bounds) {
  if (const std::string reason = why_refused(value, bounds); !reason.empty())
    throw InputError(field + ": " + format_exact(value) + ": " + reason);
}

void check_option(const std::string& option, double value, const Bounds& bounds) {
  if (const std::string reason = why_refused(value, bounds); !reason.empty()) throw OptionError(option, format_exact(value), reason);
}

std::string did_you_mean(const std::string& choices, std::string_view name, std::size_t max_names) {
  constexpr std::size_t max_length = 80;  // of a name that is compared
  if (name.empty() || name.size() > max_length) return {};
  const std::size_t max_difference = std::max<std::size_t>(1, (name.size() + 1) / 3);
  std::vector<std::pair<std::size_t, std::string_view>> similar;
  for (std::string_view rest = choices; !rest.empty();) {
    const std::string_view choice = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), choice.size() + 2));
    if (const std::size_t now = difference(name, choice); now <= max_difference) similar.emplace_back(now, choice);
  }
  std::ranges::stable_sort(similar, {}, [](const auto& each) { return each.first; });
  if (similar.size() > max_names) similar.resize(max_names);

  std::string text;
  for (std::size_t i = 0; i < similar.size(); ++i)
    text.append(i == 0 ? "did you mean " : i + 1 < similar.size() ? ", " : " or ").append(similar[i].second);
  return text.empty() ? text : text + "?";
}

std::string must_be_one_of(const std::string& choices, std::string_view name) {
  const std::string nearest = did_you_mean(choices, name, 1);
  return "must be one of " + choices + (nearest.empty() ? "" : "; " + nearest);
}

}  // namespace hooke
