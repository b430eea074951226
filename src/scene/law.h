// Laws that the motion of a scene keeps, as a scene's check asserts them: a quantity over time, and what must hold of it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

// A quantity at the ends of frames, from the law's `from` on; never empty.
struct TimeSeries {
  std::vector<double> time, value;
};

// What a law of this kind asks for. The figure is compared with `value`, or with the limits.
struct CriterionKind {
  std::string_view id;         // in files
  bool has_value, has_limits;  // must give value and within; least or most
  double (*evaluate)(const TimeSeries& series);
  std::string_view description;  // "the total FIGURE"
};
std::span<const CriterionKind> law_kinds();

// One law about one quantity over the run.
struct Criterion {
  const CriterionKind* kind = nullptr;
  std::string of;                       // the quantity's name (quantity.h)
  std::optional<double> value, within;  // in the quantity's unit; of a period [s]
  std::optional<double> min, max;
  double from = 0.0;  // [s] after the start: what was before does not count
};

struct CriterionResult {
  bool holds;
  std::string description;
};

CriterionResult evaluate_criterion(const Criterion& criterion, const TimeSeries& series);

}  // namespace hooke
