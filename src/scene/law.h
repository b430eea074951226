// Criteria of a scene check: conditions on a quantity over time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

// The values of a quantity at the ends of frames, starting at `from`; never empty.
struct TimeSeries {
  std::vector<double> time, value;
};

// A kind of criterion. Its result is compared with `value`, or with the limits.
struct CriterionKind {
  std::string_view id;         // in files
  bool has_value, has_limits;  // requires value and within; requires a minimum or a maximum
  double (*evaluate)(const TimeSeries& series);
  std::string_view description;  // "the total FIGURE"
};
std::span<const CriterionKind> law_kinds();

// A criterion for one quantity of the run.
struct Criterion {
  const CriterionKind* kind = nullptr;
  std::string of;                       // the name of the quantity (quantity.h)
  std::optional<double> value, within;  // in the unit of the quantity; of a period [s]
  std::optional<double> min, max;
  double from = 0.0;  // [s] after the start: earlier values are ignored
};

struct CriterionResult {
  bool holds;
  std::string description;
};

CriterionResult evaluate_criterion(const Criterion& criterion, const TimeSeries& series);

}  // namespace hooke
