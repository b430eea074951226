#include "study/hard_cases/hard_case.h"

#include <algorithm>

#include "study/hard_cases/rows.h"

namespace hooke {

bool is_broken(const Verdict& verdict) {
  switch (verdict.outcome) {
    case Outcome::Held:
      return verdict.expected == Expectation::Report;
    case Outcome::FailedOpenly:
      return verdict.expected == Expectation::Hold;
    case Outcome::FailedSilently:
      return true;
    case Outcome::OutOfScope:
      return false;
  }
  return true;
}

Verdict worst_of(std::span<const Verdict> parts) {
  // an unexpected result first, then a failure, then success; out of scope only if all parts are
  const auto badness = [](const Verdict& part) {
    const int outcome = part.outcome == Outcome::FailedSilently ? 3
                        : part.outcome == Outcome::FailedOpenly ? 2
                        : part.outcome == Outcome::Held         ? 1
                                                                : 0;
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
  switch (outcome) {
    case Outcome::Held:
      return "held";
    case Outcome::FailedOpenly:
      return "failed openly";
    case Outcome::FailedSilently:
      return "failed silently";
    case Outcome::OutOfScope:
      return "out of scope";
  }
  return {};
}

std::string_view describe(Expectation expectation) {
  switch (expectation) {
    case Expectation::Hold:
      return "hold";
    case Expectation::Report:
      return "report";
    case Expectation::HoldOrReport:
      return "hold or report";
  }
  return {};
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
