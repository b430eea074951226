#include "scene/law.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text_lines.h"

namespace hooke {
namespace {

double largest_change(const TimeSeries& s) {
  double max = 0.0;
  for (const double v : s.value) max = std::max(max, std::abs(v - s.value.front()));
  return max;
}

double largest_rise(const TimeSeries& s) {
  double min = s.value.front(), max = 0.0;
  for (const double v : s.value) {
    min = std::min(min, v);
    max = std::max(max, v - min);
  }
  return max;
}

double last(const TimeSeries& s) { return s.value.back(); }
double peak(const TimeSeries& s) { return *std::ranges::max_element(s.value); }
double trough(const TimeSeries& s) { return *std::ranges::min_element(s.value); }

// Mean time between upward crossings of the mid-level between the extremes, each interpolated linearly between two frames.
double period(const TimeSeries& s) {
  const double middle = 0.5 * (peak(s) + trough(s));
  double first = NAN, latest = NAN;
  int crossings = 0;
  for (std::size_t i = 1; i < s.value.size(); ++i) {
    const double before = s.value[i - 1] - middle, after = s.value[i] - middle;
    if (!(before < 0.0 && after >= 0.0)) continue;
    latest = s.time[i - 1] + (s.time[i] - s.time[i - 1]) * before / (before - after);
    if (crossings++ == 0) first = latest;
  }
  return crossings > 1 ? (latest - first) / (crossings - 1) : NAN;
}

constexpr std::array kinds{
    CriterionKind{"constant", false, false, largest_change, "changes by"},
    CriterionKind{"never_rises", false, false, largest_rise, "rises by"},
    CriterionKind{"ends_at", true, false, last, "ends at"},
    CriterionKind{"peaks_at", true, false, peak, "peaks at"},
    CriterionKind{"period", true, false, period, "has the period"},
    CriterionKind{"between", false, true, nullptr, "ranges"},
};

}  // namespace

std::span<const CriterionKind> law_kinds() { return kinds; }

CriterionResult evaluate_criterion(const Criterion& criterion, const TimeSeries& series) {
  const std::string what = criterion.of + " " + std::string(criterion.kind->description) + " ";
  if (criterion.kind->has_limits) {
    const double low = trough(series), high = peak(series);
    const bool holds = (!criterion.min || low >= *criterion.min) && (!criterion.max || high <= *criterion.max);
    return {holds, what + "from " + format_rounded(low) + " to " + format_rounded(high) + " (" +
                       (criterion.min ? format_rounded(*criterion.min) : "") + ".." +
                       (criterion.max ? format_rounded(*criterion.max) : "") + ")"};
  }
  const double evaluate = criterion.kind->evaluate(series), wanted = criterion.value.value_or(0.0);
  const std::string target = criterion.kind->has_value ? format_rounded(wanted) + " +- " : "at most ";
  return {std::abs(evaluate - wanted) <= *criterion.within,
          what + format_rounded(evaluate) + " (" + target + format_rounded(*criterion.within) + ")"};
}

}  // namespace hooke
