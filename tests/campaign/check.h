// The checks of the reliability campaign (docs/evidence/reliability.md). Each check tries one case, which is determined by its number, so
// that a campaign can continue where the previous one ended and a failure can be reproduced.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hooke {

// A claim that is false in a case; what() describes the failure.
struct Finding : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void expect(bool holds, const std::string& what) {
  if (!holds) throw Finding(what);
}

struct Check {
  std::string_view name;
  std::string_view unit;  // what `run` counts
  unsigned max_seconds;   // limit of the CPU time of a case [s]; 0: none
  // Runs a case and returns how many units it covered. Throws Finding. A crash is a finding too.
  long (*run)(std::uint64_t number);
};

// One row for each, in the file of the same name.
extern const Check round_trips, saves_killed, saves_failing, actions, replays, extremes, long_run, hostile_paths;
std::span<const Check* const> checks();

}  // namespace hooke
