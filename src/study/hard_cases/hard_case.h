// The hard cases: scenes on which methods are known to fail, each with its parameters and its criterion. A method may fail one, but never
// silently: the run itself has to report the failure. Adding a case is its row, in a file of this folder, and one line in list.inc.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "base/table.h"
#include "sim/methods/integrator.h"

namespace hooke {

enum class Outcome {
  Held,            // the criterion was met
  FailedOpenly,    // it was not, and the run reported it
  FailedSilently,  // it was not, and nothing reported it
  OutOfScope,      // does not apply to this method, or needs a feature that does not exist
};

// The outcome required.
enum class Expectation { Hold, Report, HoldOrReport };

struct Verdict {
  Outcome outcome = Outcome::Held;
  Expectation expected = Expectation::Hold;
  std::string measured;  // the figures of the criterion
  std::string reason;    // how a failure was reported, or why it is out of scope
};

bool is_broken(const Verdict& verdict);

// The worst outcome of several parts, with the figures of all.
Verdict worst_of(std::span<const Verdict> parts);

// "held", "failed openly", ...; "hold", "report", "hold or report".
std::string_view describe(Outcome outcome);
std::string_view describe(Expectation expectation);

// A list of methods, for a row.
template <const Integrator&... rows>
inline constexpr std::array<const Integrator*, sizeof...(rows)> method_list{&rows...};

struct HardCase {
  int number;
  std::string_view name;
  std::string_view parameters;
  std::string_view criterion;
  std::string_view remark;  // exceptions with their reasons, and what is not checked; may be empty
  // The quick subset leaves out what takes seconds: under every method, or under these.
  bool slow = false;
  std::span<const Integrator* const> slow_under{};
  Verdict (*judge)(const Integrator& method);  // runs it
};

// Whether the quick subset includes it.
bool is_quick(const HardCase& hard_case, const Integrator& method);

// In the order of their numbers.
Table<HardCase> hard_cases();

}  // namespace hooke
