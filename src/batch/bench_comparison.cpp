#include "batch/bench_comparison.h"

#include <algorithm>

#include "base/formatted.h"

namespace hooke {
namespace {

// Larger than the differences between references that were refined differently, smaller than those between settings.
constexpr double allowed_growth = 1.1;  // [1]

std::string failure_of(const ProblemRecord& earlier_record, const Row& earlier, const ProblemRecord& record, const Row& now) {
  const std::optional<double> before = error_with_uncertainty(earlier_record, earlier), after = error_with_uncertainty(record, now);
  if (!before) return "";
  if (!after) return formatted("%s; the error was %.3g", now.status.c_str(), *before);
  return *after <= allowed_growth * *before ? "" : formatted("error %.3g of the size, %.3g in the earlier results", *after, *before);
}

}  // namespace

std::vector<JunitCase> compare_with_earlier(const Results& earlier, const Results& now) {
  std::vector<JunitCase> cases;
  for (const ProblemRecord& record : now.problems) {
    const auto same = std::ranges::find(earlier.problems, record.id, &ProblemRecord::id);
    if (same == earlier.problems.end()) continue;
    for (const Row& row : record.rows) {
      const auto matches = [&](const Row& other) { return other.method == row.method && other.setting == row.setting; };
      if (const auto other = std::ranges::find_if(same->rows, matches); other != same->rows.end())
        cases.push_back({.group = record.id, .name = row.method + ", " + row.setting, .failure = failure_of(*same, *other, record, row)});
    }
  }
  return cases;
}

}  // namespace hooke
