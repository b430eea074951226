#include "study/hard_cases/hard_case.h"

#include <algorithm>

#include "study/hard_cases/rows.h"

namespace hooke {

bool is_broken(const Verdict& verdict) {
  const Expectation expected = verdict.expected;
  return verdict.outcome == Outcome::FailedSilently || (verdict.outcome == Outcome::Held && expected == Expectation::Report) ||
         (verdict.outcome == Outcome::FailedOpenly && expected == Expectation::Hold);
}

Verdict worst_of(std::span<const Verdict> parts) {
  // an unexpected result first, then a failure, then success; out of scope only if all parts are
  const auto badness = [](const Verdict& part) {
    const int outcome = part.outcome == Outcome::OutOfScope ? -1 : static_cast<int>(part.outcome);
    return is_broken(part) ? 10 + outcome : outcome;
  };
  Verdict worst =
      *std::max_element(parts.begin(), parts.end(), [&](const Verdict& a, const Verdict& b) { return badness(a) < badness(b); });
  worst.measured.clear();
  for (const Verdict& part : parts)
    if (!part.measured.empty()) worst.measured += (worst.measured.empty() ? "" : "; ") + part.measured;
  return worst;
}

std::string_view describe(Outcome outcome) {
  constexpr std::array<std::string_view, 4> words{"held", "failed openly", "failed silently", "out of scope"};
  return words[static_cast<std::size_t>(outcome)];
}

std::string_view describe(Expectation expectation) {
  constexpr std::array<std::string_view, 3> words{"hold", "report", "hold or report"};
  return words[static_cast<std::size_t>(expectation)];
}

Table<HardCase> hard_cases() {
  static constexpr const HardCase* rows[] = {
#define ROW(name) &(name),
#include "study/hard_cases/list.inc"
#undef ROW
  };
  return Table<HardCase>(rows);
}

bool is_quick(const HardCase& hard_case, const Integrator& method) {
  return !hard_case.slow && !std::ranges::count(hard_case.slow_under, &method);
}

}  // namespace hooke
