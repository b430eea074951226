// The hard cases: scenes on which methods are known to fail, each with its parameters and its criterion. A method may
// fail one, but never in silence: what it cannot do has to be reported by the run itself.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/integrator.h"

namespace hooke {

enum class Outcome {
  Held,            // the criterion was met
  FailedOpenly,    // it was not, and the run said so
  FailedSilently,  // it was not, and nothing said so
  OutOfScope,      // not a question to this method, or in need of something that does not exist
};

// What has to come out.
enum class Expectation { Hold, Report, HoldOrReport };

struct Verdict {
  Outcome outcome = Outcome::Held;
  Expectation expected = Expectation::Hold;
  std::string measured;                        // the figures that the criterion is about
  std::string reason;                          // how a failure was reported, or why it is out of scope
  std::vector<std::vector<std::string>> rows;  // of the case's own table, if it has one: a row a step
};

bool is_broken(const Verdict& verdict);

// The worst outcome of several parts, with the figures of all.
Verdict worst_of(std::span<const Verdict> parts);

// "held", "failed openly", ...; "hold", "report", "hold or report".
std::string_view describe(Outcome outcome);
std::string_view describe(Expectation expectation);

enum class Concerns { EveryMethod, NoMethod };

struct HardCase {
  int number;
  std::string_view name;
  std::string_view parameters;
  std::string_view criterion;
  std::string_view remark;  // what may be looser than it sounds, for whom and why, and what is not checked; may be empty
  Concerns concerns = Concerns::EveryMethod;
  std::string_view not_quick;                  // ids of the methods that it costs seconds: left out of the quick subset; "*": all
  std::string_view columns;                    // of its own table, with bars between; empty: it has none
  Verdict (*judge)(const Integrator& method);  // runs it; the default method where no method is concerned
};

// Whether the quick subset has it.
bool is_quick(const HardCase& hard_case, const Integrator& method);

// In the order of their numbers, 1 to 27.
std::span<const HardCase> hard_cases();

}  // namespace hooke
